// What a stream says about its sound. Plain data. SPEC 4.9.
#pragma once

#include <cstdint>
#include <vector>

namespace fbs {

inline constexpr std::int32_t kSoundClock = 48000;  ///< ticks per second, in which sound is timed
inline constexpr std::int32_t kMaxSoundSkip = kSoundClock;
inline constexpr std::int64_t kMaxSoundFrames = std::int64_t{1}
                                                << 32;  ///< frames of a stream: 124 days of the shortest

enum class SoundCodec : std::uint8_t {
  kOpus = 1,    ///< RFC 6716; 48 kHz
  kCodec2 = 2,  ///< Codec 2 (Rowe 2010); 8 kHz, mono
};

/// What a decoder of sound must know before the first frame.
struct SoundSetup {
  SoundCodec codec = SoundCodec::kOpus;
  std::int32_t channels = 1;    ///< 1..2; 1 for Codec 2
  std::int32_t mode = 0;        ///< for Codec 2, bit/s: 3200, 2400, 1600, 1400, 1300 or 1200; 0 for Opus
  std::int32_t duration = 960;  ///< of a frame, 1/kSoundClock s
  std::int32_t skip = 0;        ///< decoded samples before the first picture, 1/kSoundClock s: frame n begins
                                ///< at n * duration - skip
  friend bool operator==(const SoundSetup&, const SoundSetup&) = default;
};

/// Consecutive frames.
struct SoundGroup {
  std::int64_t first = 0;  ///< number of the first frame, from 0
  std::vector<std::vector<std::uint8_t>>
      frames;  ///< each a packet of the codec; empty: lost, to be concealed
  friend bool operator==(const SoundGroup&, const SoundGroup&) = default;
};

}  // namespace fbs
