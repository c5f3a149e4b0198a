// How much of each region there is at a point of the mesh. SPEC 11.1. Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/generic_head.h"
#include "common/state.h"

namespace fbs {

inline constexpr int kShareOneLog2 = 4;
inline constexpr int kShareOne = 1 << kShareOneLog2;

/// Of each Region, in 1/kShareOne; they sum to it.
using RegionShares = std::array<std::uint8_t, kRegionCount>;

/// Of the vertices of the head. A vertex belongs to mouth or eyes as far as their control points move it; the
/// rest is face.
[[nodiscard]] std::vector<RegionShares> vertex_shares(const WireFrame& head);

/// Of a point of the surround, by its weights in the map's layers.
/// @param head, body  0..kFollowOne
[[nodiscard]] RegionShares surround_shares(std::int32_t head, std::int32_t body);

}  // namespace fbs
