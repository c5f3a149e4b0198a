// Sound of a stream that waits for its pictures.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "bitstream/sound_syntax.h"
#include "common/result.h"

namespace fbs {

/// Sound as it came.
struct SoundPart {
  SoundSetup setup;
  SoundGroup group;
};

/// Most of the sound that waits for its pictures, memory_of(): an hour and a half of speech. Streams that
/// have more of it before a picture are none of an encoder.
inline constexpr std::size_t kMaxSoundAhead = std::size_t{1} << 24;

/// About what a frame of sound takes, and a group; bytes.
[[nodiscard]] std::size_t memory_of(const std::vector<std::uint8_t>& frame);
[[nodiscard]] std::size_t memory_of(const SoundGroup& group);

class SoundInbox {
 public:
  /// Keeps what is added from now on. Off by default.
  void keep() { keeps_ = true; }
  /// @return kTooLarge, and it is left out, beyond kMaxSoundAhead
  [[nodiscard]] Result<void> add(SoundPart part);
  /// What has been added since the last call.
  [[nodiscard]] std::vector<SoundPart> take() {
    size_ = 0;
    return std::exchange(parts_, {});
  }

 private:
  bool keeps_ = false;
  std::vector<SoundPart> parts_;
  std::size_t size_ = 0;  // memory_of() them
};

}  // namespace fbs
