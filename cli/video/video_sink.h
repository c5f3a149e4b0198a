// One interface to the destinations of pictures: files, image sequences, pipes and nowhere.
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
  /// @param pts      1/90000 s, above the one before; Y4M and image sequences keep the order only
  /// @return ErrorCode::kIo with the system's reason (no space left on device, ...);
  ///         after an error the sink must not be used further
  virtual Result<void> write(const Picture& picture, std::int64_t pts) = 0;

  /// A frame of the sound that SinkOptions describe, in order; pictures and sound are best given as their
  /// times come.
  /// @param frame  a packet of Opus; empty: lost, silence
  /// @param begin  1/kSoundClock s from time 0 of the pictures, at the end of the frame before or later; the
  ///               first is before 0 by the setup's skip
  /// @return ErrorCode::kUnsupported when the sink has no such sound, else as write()
  virtual Result<void> write_sound(std::span<const std::uint8_t> /*frame*/, std::int64_t /*begin*/) {
    return fail(ErrorCode::kUnsupported, "the output has no sound");
  }

  /// Whether an unfinished file of an earlier run was in the way and has been replaced.
  [[nodiscard]] virtual bool replaced_leftover() const { return false; }

  /// Completes the output and gives it its final name. Call it once, last.
  virtual Result<void> finish() = 0;
};

struct SinkOptions {
  /// .mp4 and .mkv: file whose sound is copied into the output; none when empty.
  std::string sound_source = {};
  /// 1/90000 s: sound before this time is left out, and what follows is earlier.
  std::int64_t sound_begin = 0;
  /// .mp4 and .mkv: Opus that write_sound brings; not together with sound_source.
  std::optional<SoundSetup> sound = std::nullopt;
};

}  // namespace fbs
