// What a stream says of its sound. Plain data. SPEC 4.9.
#pragma once

#include <cstdint>
#include <vector>

namespace fbs {

inline constexpr std::int32_t kSoundClock = 48000;  ///< ticks of a second, in which sound is timed
inline constexpr std::int32_t kMaxSoundSkip = kSoundClock;
inline constexpr std::int64_t kMaxSoundFrames = std::int64_t{1}
                                                << 32;  ///< of a stream: 124 days of the shortest

enum class SoundCodec : std::uint8_t {
  kOpus = 1,    ///< RFC 6716; 48 kHz
  kCodec2 = 2,  ///< Codec 2 (Rowe 2010); 8 kHz, mono
};

/// What a decoder of sound must know before the first frame.
struct SoundSetup {
  SoundCodec codec = SoundCodec::kOpus;
  std::int32_t channels = 1;    ///< 1..2; of Codec 2 1
  std::int32_t mode = 0;        ///< of Codec 2, bit/s: 3200, 2400, 1600, 1400, 1300 or 1200; of Opus 0
  std::int32_t duration = 960;  ///< of a frame, 1/kSoundClock s
  std::int32_t skip = 0;        ///< 1/kSoundClock s of what is decoded lie before the first picture: frame n
                                ///< begins at n * duration - skip
  friend bool operator==(const SoundSetup&, const SoundSetup&) = default;
};

/// Frames that follow one another.
struct SoundGroup {
  std::int64_t first = 0;  ///< number of the first frame, from 0
  std::vector<std::vector<std::uint8_t>>
      frames;  ///< each a packet of the codec; empty: lost, to be concealed
  friend bool operator==(const SoundGroup&, const SoundGroup&) = default;
};

}  // namespace fbs
