// The modes of Codec 2 that a stream may use. SPEC 4.9.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bitstream/sound_syntax.h"

namespace fbs {

inline constexpr int kCodec2Rate = 8000;                                 ///< samples a second
inline constexpr std::int32_t kCodec2Ticks = kSoundClock / kCodec2Rate;  ///< ticks of a sample

struct Codec2Mode {
  std::int32_t bitrate = 0;       ///< bit/s; names the mode: SoundSetup::mode
  std::size_t frame_samples = 0;  ///< 160 or 320
  std::size_t frame_bytes = 0;    ///< 6 to 8

  /// Duration of a frame, 1/kSoundClock s.
  [[nodiscard]] constexpr std::int32_t duration() const {
    return static_cast<std::int32_t>(frame_samples) * kCodec2Ticks;
  }
  /// Bit/s sent, as frames are whole bytes: 1400 in mode 1300, else `bitrate`.
  [[nodiscard]] constexpr std::int32_t sent_bitrate() const {
    return static_cast<std::int32_t>(frame_bytes * 8 * kCodec2Rate / frame_samples);
  }
};

/// From the highest rate to the lowest.
[[nodiscard]] std::span<const Codec2Mode> codec2_modes();

/// The mode with this SoundSetup::mode; null when there is none.
[[nodiscard]] const Codec2Mode* find_codec2_mode(std::int32_t bitrate);

}  // namespace fbs
