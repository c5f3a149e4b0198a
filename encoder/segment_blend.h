// How the pictures of a segment are drawn from patterns: modes chosen for given patterns, and patterns solved
// for given modes.
#pragma once

#include <span>
#include <vector>

#include "encoder/blend/mode_errors.h"
#include "encoder/blend/pattern_solver.h"
#include "encoder/segment.h"

namespace fbs {

/// Patterns that can be used in each picture of the segment, by group.
struct SegmentPatterns {
  BlendScene scene;
  std::vector<AvailablePatterns> available;  ///< of each group
};

/// What the modes of each picture cost in distortion. Luma only, at a reduced size.
[[nodiscard]] Result<std::vector<ModeErrors>> mode_errors(Segment& segment, const SegmentPatterns& patterns);

/// Modes of each picture by rate-distortion cost. Luma only, at a reduced size.
/// @param lambda  squared luma levels that a bit is worth
/// @param most    so many pictures at most share their modes, and the first stands for all; never across a
/// cut
[[nodiscard]] Result<std::vector<RegionModes>> choose_modes(Segment& segment, const SegmentPatterns& patterns,
                                                            double lambda, std::size_t most);

/// Luma error of the segment in its cheapest modes, mean over samples, from every so many pictures.
[[nodiscard]] Result<double> blend_loss(Segment& segment, const SegmentPatterns& patterns, std::size_t every);

/// Pictures that, coded as the last `count` patterns, draw the segment best in the modes of its states. All
/// planes.
/// @param count  the others are as they are
[[nodiscard]] Result<std::vector<Picture>> solve_patterns(Segment& segment, const SegmentPatterns& patterns,
                                                          std::size_t count, const SolverSettings& settings);

}  // namespace fbs
