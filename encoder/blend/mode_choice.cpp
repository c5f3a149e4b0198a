#include "encoder/blend/mode_choice.h"

#include <algorithm>

namespace fbs {
namespace {

// Approximate bits of the adaptive code, measured on the ten clips.
constexpr double kStayBits = 0.06, kChangeBits = 8;

std::vector<BlendMode> cheapest(std::span<const ModeErrors> errors, std::size_t region, double lambda,
                                BlendMode before) {
  constexpr auto kCount = static_cast<std::size_t>(kBlendModeCount);
  std::array<double, kCount> cost{};
  cost.fill(lambda * kChangeBits);
  cost[static_cast<std::size_t>(before)] = lambda * kStayBits;
  std::vector<std::array<std::uint8_t, kCount>> from(errors.size());
  for (std::size_t t = 0; t < errors.size(); ++t) {
    if (t > 0) {
      const std::size_t best = std::min_element(cost.begin(), cost.end()) - cost.begin();
      std::array<double, kCount> next{};
      for (std::size_t m = 0; m < kCount; ++m) {
        const double stay = cost[m] + lambda * kStayBits, change = cost[best] + lambda * kChangeBits;
        from[t][m] = static_cast<std::uint8_t>(stay <= change ? m : best);
        next[m] = std::min(stay, change);
      }
      cost = next;
    }
    for (std::size_t m = 0; m < kCount; ++m) cost[m] += errors[t][region][m];
  }
  std::vector<BlendMode> out(errors.size());
  std::size_t mode = std::min_element(cost.begin(), cost.end()) - cost.begin();
  for (std::size_t t = errors.size(); t-- > 0;) {
    out[t] = static_cast<BlendMode>(mode);
    mode = from[t][mode];
  }
  return out;
}

}  // namespace

std::vector<RegionModes> cheapest_modes(std::span<const ModeErrors> errors, double lambda,
                                        const RegionModes& before) {
  std::vector<RegionModes> out(errors.size());
  for (std::size_t r = 0; r < kRegionCount; ++r) {
    const std::vector<BlendMode> modes = cheapest(errors, r, lambda, before[r]);
    for (std::size_t t = 0; t < out.size(); ++t) out[t][r] = modes[t];
  }
  return out;
}

}  // namespace fbs
