// Which patterns a picture is blended from, and their weights in each region. SPEC 11. Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/state.h"
#include "decoder/field/point_weights.h"

namespace fbs {

/// A texture: a pattern, warped from its seen state to the picture's, or shown unwarped.
struct BlendSource {
  std::uint8_t pattern = 0;  ///< index into the patterns
  bool still = false;        ///< not warped
  friend bool operator==(const BlendSource&, const BlendSource&) = default;
};

struct WeightedSource {
  BlendSource source;
  std::int32_t weight = 0;  ///< 1..kBlendOne
};

/// Sources of one region; weights sum to kBlendOne. At most kMaxRegionSources, distinct, by rising pattern,
/// warped before still.
using RegionBlend = std::vector<WeightedSource>;
inline constexpr std::size_t kMaxRegionSources = 8;

/// The blend of each region.
using PictureBlend = std::array<RegionBlend, kRegionCount>;

/// Patterns as seen from one picture, for deriving their weights. SPEC 11.3.
class BlendWeights {
 public:
  /// @param seen     state of each pattern, with its number; not empty
  /// @param picture  state to be drawn
  BlendWeights(std::span<const State* const> seen, const State& picture);

  /// @param mode  below kBlendModeCount; a mode that names a pattern beyond the last takes the farthest
  [[nodiscard]] RegionBlend blend(Region region, BlendMode mode) const;

 private:
  using Weights = std::vector<std::int64_t>;
  [[nodiscard]] std::vector<std::int64_t> distances(Region region) const;
  [[nodiscard]] Weights by_state(Region region) const;

  std::span<const State* const> seen_;
  const State& picture_;
  std::int32_t spacing_ = 1;
  std::size_t before_ = 0, after_ = 0;  ///< patterns next to the picture in time; equal at the ends
  std::int64_t share_after_ = 0;        ///< of pattern after_ in a cross-fade, 0..2^16
};

/// Blends of all regions, by the modes of the state.
[[nodiscard]] PictureBlend blend_picture(std::span<const State* const> seen, const State& picture);

}  // namespace fbs
