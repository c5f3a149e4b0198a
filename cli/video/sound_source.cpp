#include "cli/video/sound_source.h"

#include <filesystem>
#include <system_error>

#include "cli/module.h"
#include "cli/video/video_modules.h"
#include "cli/video/video_source.h"

namespace fbs {
namespace {

namespace fs = std::filesystem;

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

Error missing_track(const std::string& input, int track, std::ptrdiff_t count) {
  std::string has = "no sound";
  if (count == 1) has = "one, number 0";
  if (count > 1) has = std::to_string(count) + ", from 0 to " + std::to_string(count - 1);
  return {ErrorCode::kInvalidArgument,
          input + ": no sound track " + std::to_string(track) + ": it has " + has};
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
