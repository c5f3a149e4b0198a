#include "decoder/sound/codec2_mode.h"

#include <codec2/codec2.h>

#include <algorithm>
#include <array>

namespace fbs {
namespace {

// clang-format off
constexpr std::array<Codec2Mode, 6> kModes = {{
    // bit/s          id        samples bytes
    {3200, CODEC2_MODE_3200, 160, 8},
    {2400, CODEC2_MODE_2400, 160, 6},
    {1600, CODEC2_MODE_1600, 320, 8},
    {1400, CODEC2_MODE_1400, 320, 7},
    {1300, CODEC2_MODE_1300, 320, 7},
    {1200, CODEC2_MODE_1200, 320, 6},
}};
// clang-format on

}  // namespace

std::span<const Codec2Mode> codec2_modes() {
  return kModes;
}

const Codec2Mode* find_codec2_mode(std::int32_t bitrate) {
  const auto found = std::find_if(kModes.begin(), kModes.end(),
                                  [&](const Codec2Mode& mode) { return mode.bitrate == bitrate; });
  return found == kModes.end() ? nullptr : &*found;
}

}  // namespace fbs
