#include "decoder/raster/blend_weights.h"

namespace fbs {

LinearWeight::LinearWeight(const TriangleSetup& setup, const std::array<std::int32_t, 3>& weight)
    : gradient_(setup.gradient(weight, 0)), position_bits_(setup.position_bits()), is_tame_(gradient_.exact()) {
  const auto step = static_cast<std::uint32_t>(gradient_.dx);
  steps_[0] = WideLanes{0, 1, 2, 3} * step;
  steps_[1] = WideLanes{4, 5, 6, 7} * step;
}

Lanes LinearWeight::at_plain(const RowBlock& block) const {
  const std::int64_t first = gradient_.at(block.at, position_bits_);
  Lanes out{};
  for (int i = 0; i < block.count; ++i)
    out[i] = static_cast<std::uint16_t>(
        std::clamp<std::int64_t>((first + i * gradient_.dx) >> kGradientOneLog2, 0, kWeightOne));
  return out;
}

}  // namespace fbs
