// A video of what the player has shown.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "cli/decode/decoded_time.h"
#include "cli/play/sound/recorded_sound.h"
#include "cli/video/video_sink.h"

namespace fbs::cli {

/// Writes pictures in sequence, each as long as it lasts in the stream, however long it was on screen, with
/// the sound that belongs to each.
class Recording {
 public:
  /// @param sound  none: there is none, or the format of `name` has no sound
  static Result<Recording> open(const std::string& name, const VideoFormat& format,
                                std::optional<RecordedSound> sound);

  /// @param duration  1/90000 s
  Result<void> write(const Picture& picture, std::uint32_t duration, const SoundSpan& sound);
  /// Gives the file its name. Call once, last.
  Result<void> finish();

 private:
  Recording(std::unique_ptr<VideoSink> sink, Rational rate, std::optional<RecordedSound> sound)
      : sink_(std::move(sink)), sound_(std::move(sound)), time_(rate) {}

  std::unique_ptr<VideoSink> sink_;
  std::optional<RecordedSound> sound_;
  DecodedTime time_;
};

}  // namespace fbs::cli
