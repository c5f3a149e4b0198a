// The content of a Matroska file with a stream: tracks and their blocks. Plain data.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace fbs::cli {

struct MatroskaBlock {
  std::int64_t time = 0;      ///< ns, 0..kMaxMatroskaTime; for sound including the codec's delay
  std::int64_t duration = 0;  ///< ns
  bool key = true;            ///< can be decoded without earlier blocks
  std::vector<std::uint8_t> bytes;
};

/// Ten years: longer than any recording, and far from overflowing 64 bits.
inline constexpr std::int64_t kMaxMatroskaTime = std::int64_t{10 * 365 * 86400} * 1'000'000'000;

/// Track with codec ID V_FBS.
struct MatroskaVideo {
  int width = 0, height = 0;          ///< pixels
  int display_width = 0;              ///< width in square pixels, for the same height
  std::int64_t picture_duration = 0;  ///< ns; 0: varies
  std::vector<std::uint8_t> setup;    ///< CodecPrivate: signature and first setup packet
  std::vector<MatroskaBlock> blocks;
};

/// Track with codec ID A_OPUS.
struct MatroskaSound {
  int channels = 1;
  std::int32_t skip = 0;      ///< samples to skip at the start, 1/kSoundClock s
  std::int32_t duration = 0;  ///< of a frame, 1/kSoundClock s
  std::vector<MatroskaBlock> blocks;
};

struct MatroskaContent {
  MatroskaVideo video;
  std::optional<MatroskaSound> sound;
};

}  // namespace fbs::cli
