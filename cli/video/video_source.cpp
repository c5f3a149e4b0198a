#include "cli/video/video_source.h"

#include <filesystem>
#include <system_error>

#include "cli/module.h"
#include "cli/video/images/number_pattern.h"
#include "cli/video/video_modules.h"
#include "cli/video/y4m.h"

namespace fbs {
namespace {

namespace fs = std::filesystem;

bool is_image_sequence(const std::string& input) {
  std::error_code ignored;
  const fs::file_status status = fs::status(input, ignored);
  if (fs::is_directory(status)) return true;
  if (fs::exists(status)) return false;
  if (input.find("://") != std::string::npos) return false;
  const std::string name = fs::path(input).filename().string();
  return name.find_first_of("*?") != std::string::npos || parse_number_pattern(name).has_value();
}

Result<std::unique_ptr<VideoSource>> open_by_module(const char* module, const std::string& input,
                                                    const SourceOptions& options) {
  const auto open = load_module_function<OpenSourceFunction>(module, kOpenSourceSymbol);
  if (!open) return fail(open.error().code, "cannot read " + input + ": " + open.error().text);
  Result<std::unique_ptr<VideoSource>> source;
  (*open)(input, options, source);
  return source;
}

}  // namespace

Result<std::unique_ptr<VideoSource>> open_video_source(const std::string& input,
                                                       const SourceOptions& options) {
  if (input == "-" || input.ends_with(".y4m")) return open_y4m_source(input);
  if (input.starts_with("camera:")) return open_by_module(kCameraModule, input, options);
  if (is_image_sequence(input)) return open_by_module(kImageModule, input, options);
  return open_by_module(kAvModule, input, options);
}

}  // namespace fbs
