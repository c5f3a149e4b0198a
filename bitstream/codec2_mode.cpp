#include "bitstream/codec2_mode.h"

#include <algorithm>
#include <array>

namespace fbs {
namespace {

constexpr std::array<Codec2Mode, 6> kModes = {
    {{3200, 160, 8}, {2400, 160, 6}, {1600, 320, 8}, {1400, 320, 7}, {1300, 320, 7}, {1200, 320, 6}}};

}  // namespace

std::span<const Codec2Mode> codec2_modes() {
  return kModes;
}

const Codec2Mode* find_codec2_mode(std::int32_t bitrate) {
  const auto* const found = std::find_if(kModes.begin(), kModes.end(),
                                         [&](const Codec2Mode& mode) { return mode.bitrate == bitrate; });
  return found == kModes.end() ? nullptr : found;
}

}  // namespace fbs
