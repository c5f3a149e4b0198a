// Weights of the sources of a picture at the points of its mesh. SPEC 11.5. Integers only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace fbs {

inline constexpr int kBlendOneLog2 = 8;
inline constexpr int kBlendOne = 1 << kBlendOneLog2;  ///< weights of a region sum to this
inline constexpr int kMeshWeightOne = 16 * kBlendOne;

/// Weights of `sources` at points of the mesh, a row for each point; each row sums to kMeshWeightOne.
struct PointWeights {
  std::size_t sources = 0;
  std::vector<std::int32_t> weights;
  [[nodiscard]] std::span<const std::int32_t> at(std::size_t point) const {
    return std::span(weights).subspan(point * sources, sources);
  }
};

}  // namespace fbs
