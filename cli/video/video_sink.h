// One interface to all destinations of pictures: files, image sequences, pipes and nowhere.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "bitstream/sound_syntax.h"
#include "common/picture.h"
#include "common/result.h"

namespace fbs {

/// Takes pictures in presentation order. No file has its final name before finish() has succeeded: files are
/// written as `NAME.part`, and the destructor removes unfinished ones. Errors name the output.
class VideoSink {
 public:
  virtual ~VideoSink() = default;

  /// @param picture  of the format's size
  /// @param pts      1/90000 s, rising; Y4M and image sequences keep the order only
  /// @return ErrorCode::kIo with the system's reason (no space left on device, ...);
  ///         after an error the sink must not be used further
  virtual Result<void> write(const Picture& picture, std::int64_t pts) = 0;

  /// Writes a frame of the sound that SinkOptions describe, in order; best interleaved with the pictures by
  /// time.
  /// @param frame  an Opus packet; empty: lost, silence
  /// @param begin  1/kSoundClock s from time 0 of the pictures, not before the end of the previous frame; the
  ///               first is before 0 by the setup's skip
  /// @return ErrorCode::kUnsupported when the sink has no such sound, else as write()
  virtual Result<void> write_sound(std::span<const std::uint8_t> /*frame*/, std::int64_t /*begin*/) {
    return fail(ErrorCode::kUnsupported, "the output has no sound");
  }

  /// Whether an unfinished file of an earlier run was replaced.
  [[nodiscard]] virtual bool replaced_leftover() const { return false; }

  /// Completes the output and gives it its final name. Call once, last.
  virtual Result<void> finish() = 0;
};

struct SinkOptions {
  /// .mp4 and .mkv: file whose sound is copied into the output; none when empty.
  std::string sound_source = {};
  /// 1/90000 s: sound before this time is left out, and later sound moves earlier by as much.
  std::int64_t sound_begin = 0;
  /// .mp4 and .mkv: Opus passed to write_sound; not together with sound_source.
  std::optional<SoundSetup> sound = std::nullopt;
};

}  // namespace fbs
