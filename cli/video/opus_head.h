// The identification header of Opus, stored in MP4 and Matroska as the setup of a track.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "bitstream/sound_syntax.h"

namespace fbs {

/// RFC 7845, section 5.1, with mapping family 0 and no gain.
using OpusHead = std::array<std::uint8_t, 19>;

/// @param channels  1..2
/// @param skip      pre-skip, 1/kSoundClock s, 0..65535
[[nodiscard]] constexpr OpusHead opus_head(int channels, std::int32_t skip) {
  const auto byte = [](std::int32_t value, std::size_t index) {
    return static_cast<std::uint8_t>(static_cast<std::uint32_t>(value) >> (8 * index));
  };
  OpusHead head{'O', 'p', 'u', 's', 'H', 'e', 'a', 'd', 1};
  head[9] = static_cast<std::uint8_t>(channels);
  for (std::size_t i = 0; i < 2; ++i) head[10 + i] = byte(skip, i);
  for (std::size_t i = 0; i < 4; ++i) head[12 + i] = byte(kSoundClock, i);
  return head;
}

}  // namespace fbs
