// How far a pattern is from a picture, for one region: the distance of their states and times. SPEC 11.2.
// Integers only.
#pragma once

#include <cstdint>

#include "common/state.h"

namespace fbs {

inline constexpr std::int64_t kDistanceOne = 1 << 16;  ///< squared distances are in 2^-16

/// Squared distance in the look of a region. Shift and scale of the head do not count: they change where it
/// is, not how it looks.
/// @param spacing  mean number of pictures from one pattern to the next, at least 1
[[nodiscard]] std::int64_t state_distance(Region region, const State& pattern, const State& picture,
                                          std::int32_t spacing);

}  // namespace fbs
