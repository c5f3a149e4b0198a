#include "cli/video/video_sink.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "cli/module.h"
#include "cli/video/images/number_pattern.h"
#include "cli/video/video_modules.h"
#include "cli/video/y4m/y4m.h"

namespace fbs {
namespace {

class NullSink final : public VideoSink {
 public:
  Result<void> write(const Picture& /*picture*/, std::int64_t /*pts*/) override { return {}; }
  Result<void> finish() override { return {}; }
};

Result<std::unique_ptr<VideoSink>> open_by_module(const char* module, const std::string& output,
                                                  const VideoFormat& format, const SinkOptions& options) {
  const auto open = load_module_function<OpenSinkFunction>(module, kOpenSinkSymbol);
  if (!open) return fail(open.error().code, "cannot write " + output + ": " + open.error().text);
  Result<std::unique_ptr<VideoSink>> sink;
  (*open)(output, format, options, sink);
  return sink;
}

}  // namespace

Result<void> VideoSink::write_sound(std::span<const std::uint8_t> /*frame*/, std::int64_t /*begin*/) {
  return fail(ErrorCode::kUnsupported, "the output has no sound");
}

bool has_sound_track(const std::string& output) {
  std::string extension = std::filesystem::path(output).extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".mp4" || extension == ".mkv";
}

Result<std::unique_ptr<VideoSink>> open_video_sink(const std::string& output, const VideoFormat& format,
                                                   const SinkOptions& options) {
  if (!options.sound_source.empty() && options.sound) {
    return fail(ErrorCode::kInvalidArgument, "cannot write " + output + ": it takes one sound, not two");
  }
  if (has_sound_track(output)) {
    return open_by_module(kAvModule, output, format, options);
  }
  if (!options.sound_source.empty() || options.sound) {
    return fail(ErrorCode::kUnsupported, "cannot write " + output + ": sound needs .mp4 or .mkv");
  }
  if (output == "null:") return std::make_unique<NullSink>();
  if (is_y4m_output(output)) return open_y4m_sink(output, format);
  if (parse_number_pattern(std::filesystem::path(output).filename().string())) {
    return open_by_module(kImageModule, output, format, options);
  }
  return fail(ErrorCode::kUnsupported,
              "cannot write " + output +
                  ": use .y4m, .mp4, .mkv, an image sequence such as frame_%05d.png, "
                  "- or null:");
}

}  // namespace fbs
