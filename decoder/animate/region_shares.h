// Shares of the regions at a point of the mesh. SPEC 11.1. Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/generic_head.h"
#include "common/state.h"

namespace fbs {

inline constexpr int kShareOneLog2 = 4;
inline constexpr int kShareOne = 1 << kShareOneLog2;

/// Share of each Region, in 1/kShareOne; they sum to it.
using RegionShares = std::array<std::uint8_t, kRegionCount>;

/// Shares at each vertex of the head. A vertex belongs to mouth or eyes as far as their control points move
/// it; the rest is face.
[[nodiscard]] std::vector<RegionShares> vertex_shares(const WireFrame& head);

/// Shares at a point of the surround, from its weights in the map's layers.
/// @param head, body  0..kFollowOne
[[nodiscard]] RegionShares surround_shares(std::int32_t head, std::int32_t body);

}  // namespace fbs
