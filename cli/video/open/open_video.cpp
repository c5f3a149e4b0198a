#include "cli/video/open/open_video.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include "bitstream/packet.h"
#include "cli/files/number_pattern.h"
#include "cli/program/module.h"
#include "cli/video/orientation.h"
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

/// A source whose pictures are turned.
class TurnedSource final : public VideoSource {
 public:
  TurnedSource(std::unique_ptr<VideoSource> source, Orientation turn)
      : source_(std::move(source)), turn_(turn), format_(source_->format()) {
    if (!turn.transposed) return;
    std::swap(format_.width, format_.height);
    if (format_.pixel_aspect.num != 0) std::swap(format_.pixel_aspect.num, format_.pixel_aspect.den);
  }

  [[nodiscard]] const VideoFormat& format() const override { return format_; }
  Result<std::optional<TimedPicture>> next() override {
    auto picture = source_->next();
    if (picture && *picture) (*picture)->picture = oriented(std::move((*picture)->picture), turn_);
    return picture;
  }
  [[nodiscard]] bool is_ready(std::chrono::milliseconds patience) const override {
    return source_->is_ready(patience);
  }
  [[nodiscard]] bool has_constant_rate() const override { return source_->has_constant_rate(); }
  [[nodiscard]] std::optional<std::int64_t> frame_count_estimate() const override {
    return source_->frame_count_estimate();
  }
  [[nodiscard]] std::optional<double> seconds_estimate() const override {
    return source_->seconds_estimate();
  }
  [[nodiscard]] std::int64_t damaged_packets() const override { return source_->damaged_packets(); }
  [[nodiscard]] std::vector<std::string> notes() const override { return source_->notes(); }

 private:
  std::unique_ptr<VideoSource> source_;
  Orientation turn_;
  VideoFormat format_;
};

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

/// Whether sound and pictures can be read by two readers of the same file.
bool can_be_read_twice(const std::string& input) {
  std::error_code ignored;
  const fs::file_status status = fs::status(input, ignored);
  if (fs::exists(status)) return fs::is_regular_file(status);
  const bool address = input.find(':') != std::string::npos;
  return !address || input.starts_with("http://") || input.starts_with("https://") ||
         input.starts_with("file:");
}

bool may_have_sound(const std::string& input) {
  return input != "-" && !input.ends_with(".y4m") && !input.starts_with("camera:") &&
         !is_image_sequence(input) && !is_stream_file(input) && can_be_read_twice(input);
}

Result<void> check(const SoundSourceOptions& options) {
  const bool rate_known = options.sample_rate >= 8000 && options.sample_rate <= 192000;
  const bool channels_known = options.channels == 1 || options.channels == 2;
  if (rate_known && channels_known) return {};
  return fail(ErrorCode::kInvalidArgument, "sound of " + std::to_string(options.sample_rate) + " Hz with " +
                                               std::to_string(options.channels) +
                                               " channels: 8000 to 192000 Hz, mono and stereo are possible");
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

namespace {

Result<std::unique_ptr<VideoSource>> open_as_stored(const std::string& input, const SourceOptions& options) {
  if (input == "-" || input.ends_with(".y4m")) return open_y4m_source(input);
  if (input.starts_with("camera:")) return open_by_module(kCameraModule, input, options);
  if (is_image_sequence(input)) return open_by_module(kImageModule, input, options);
  if (is_stream_file(input))
    return fail(ErrorCode::kUnsupported,
                "cannot read " + input + ": it is an fbs stream, not a video; fbs decode makes one of it");
  return open_by_module(kAvModule, input, options);
}

}  // namespace

Result<std::unique_ptr<VideoSource>> open_video_source(const std::string& input,
                                                       const SourceOptions& options) {
  auto source = open_as_stored(input, options);
  if (!source || options.rotate == 0) return source;
  return std::make_unique<TurnedSource>(std::move(*source), orientation_of_turn(options.rotate));
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

Result<std::unique_ptr<SoundSource>> open_sound_source(const std::string& input,
                                                       const SoundSourceOptions& options) {
  if (auto checked = check(options); !checked) return fail(checked.error());
  if (!may_have_sound(input)) {
    if (options.track) return fail(missing_track(input, *options.track, 0));
    return nullptr;
  }
  const auto open = load_module_function<OpenSoundSourceFunction>(kAvModule, kOpenSoundSourceSymbol);
  if (!open) return fail(open.error().code, "cannot read " + input + ": " + open.error().text);
  Result<std::unique_ptr<SoundSource>> source;
  (*open)(input, options, source);
  return source;
}

}  // namespace fbs
