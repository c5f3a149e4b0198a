// Chooses the blend mode of each region in each picture by rate-distortion cost.
#pragma once

#include <span>
#include <vector>

#include "common/state.h"
#include "encoder/blend/mode_errors.h"

namespace fbs {

/// The cheapest sequence of modes of each region (Viterbi, 1967).
/// @param errors  of consecutive pictures
/// @param lambda  squared luma levels that a bit is worth
/// @param before  modes of the picture before, or a scene's initial ones
[[nodiscard]] std::vector<RegionModes> cheapest_modes(std::span<const ModeErrors> errors, double lambda,
                                                      const RegionModes& before = {});

}  // namespace fbs
