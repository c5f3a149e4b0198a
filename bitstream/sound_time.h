// Converts times of pictures to times of sound.
#pragma once

#include <cstdint>

#include "bitstream/sound_syntax.h"
#include "common/picture.h"

namespace fbs {

/// How much a decoder must decode before the place where it joins, 1/kSoundClock s. RFC 7845, section 4.6,
/// for Opus; Codec 2 needs less.
inline constexpr std::int32_t kSoundPreroll = kSoundClock * 80 / 1000;

/// The sound's time for a time of pictures. Uses the reduced fraction, so that any time of a stream fits 64
/// bits.
/// @param ticks  1/90000 s, 0..kMaxStreamTime
/// @return 1/kSoundClock s, rounded down
[[nodiscard]] constexpr std::int64_t sound_time(std::int64_t ticks) {
  constexpr std::int64_t kDivisor = 6000;
  static_assert(kSoundClock % kDivisor == 0 && kTicksPerSecond % kDivisor == 0);
  return ticks * (kSoundClock / kDivisor) / (kTicksPerSecond / kDivisor);
}

/// When the samples of a frame begin: SPEC 4.10.
/// @param frame  its number in the stream, below kMaxSoundFrames
/// @return 1/kSoundClock s from the first picture; negative before it
[[nodiscard]] constexpr std::int64_t frame_time(const SoundSetup& setup, std::int64_t frame) {
  return frame * setup.duration - setup.skip;
}

}  // namespace fbs
