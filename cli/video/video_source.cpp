#include "cli/video/video_source.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "bitstream/packet.h"
#include "cli/module.h"
#include "cli/video/images/number_pattern.h"
#include "cli/video/video_modules.h"
#include "cli/video/y4m/y4m.h"

namespace fbs {
namespace {

namespace fs = std::filesystem;

/// The tracks are described within the first bytes of a Matroska file: writers put them first.
constexpr std::size_t kTracksWithin = 1 << 16;

Result<std::unique_ptr<VideoSource>> open_by_module(const char* module, const std::string& input,
                                                    const SourceOptions& options) {
  const auto open = load_module_function<OpenSourceFunction>(module, kOpenSourceSymbol);
  if (!open) return fail(open.error().code, "cannot read " + input + ": " + open.error().text);
  Result<std::unique_ptr<VideoSource>> source;
  (*open)(input, options, source);
  return source;
}

}  // namespace

bool is_image_sequence(const std::string& input) {
  std::error_code ignored;
  const fs::file_status status = fs::status(input, ignored);
  if (fs::is_directory(status)) return true;
  if (fs::exists(status)) return false;
  if (input.find("://") != std::string::npos) return false;
  const std::string name = fs::path(input).filename().string();
  return name.find_first_of("*?") != std::string::npos || parse_number_pattern(name).has_value();
}

bool is_stream_file(const std::string& name) {
  std::error_code ignored;
  if (!fs::is_regular_file(name, ignored)) return false;  // reading a pipe would consume it
  std::ifstream file(name, std::ios::binary);
  std::string start(kTracksWithin, '\0');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  const auto begins_with = [&](const std::array<std::uint8_t, 4>& bytes) {
    return start.starts_with(std::string(bytes.begin(), bytes.end()));
  };
  return begins_with(kSignature) || (begins_with(kEbmlHead) && start.find("V_FBS") != std::string::npos);
}

Result<std::unique_ptr<VideoSource>> open_video_source(const std::string& input,
                                                       const SourceOptions& options) {
  if (input == "-" || input.ends_with(".y4m")) return open_y4m_source(input);
  if (input.starts_with("camera:")) return open_by_module(kCameraModule, input, options);
  if (is_image_sequence(input)) return open_by_module(kImageModule, input, options);
  if (is_stream_file(input))
    return fail(ErrorCode::kUnsupported,
                "cannot read " + input + ": it is an fbs stream, not a video; fbs decode makes one of it");
  return open_by_module(kAvModule, input, options);
}

}  // namespace fbs
