// How the pictures of a segment are drawn from patterns: modes chosen for given patterns, and patterns solved
// for given modes.
#pragma once

#include <span>
#include <vector>

#include "encoder/blend/mode_errors.h"
#include "encoder/blend/pattern_solver.h"
#include "encoder/segment/segment.h"

namespace fbs {

/// Patterns that can be used in each picture of the segment, by group.
struct SegmentPatterns {
  BlendScene scene;
  std::vector<AvailablePatterns> available;  ///< of each group
};

/// What blend modes cost in distortion. Luma only, at a reduced size.
struct SegmentErrors {
  /// Pictures in a row for which the first stands.
  struct Run {
    ModeErrors errors;  ///< of its first picture
    std::size_t pictures;
  };
  std::vector<Run> runs;

  /// Modes of each picture by rate-distortion cost.
  /// @param lambda  squared luma levels that a bit is worth
  /// @param before  modes of the picture before the segment
  [[nodiscard]] std::vector<RegionModes> cheapest_modes(double lambda, const RegionModes& before = {}) const;
};

/// Pictures that share their errors at most where modes are chosen anew later on.
inline constexpr std::size_t kDraftShared = 3;

/// @param most  so many pictures at most are a run; never across a cut
[[nodiscard]] Result<SegmentErrors> mode_errors(Segment& segment, const SegmentPatterns& patterns,
                                                std::size_t most);

/// Luma error of the segment in its cheapest modes, mean over samples, from every so many pictures.
[[nodiscard]] Result<double> blend_loss(Segment& segment, const SegmentPatterns& patterns, std::size_t every);

/// Pictures that, coded as the last `count` patterns, draw the segment best in the modes of its states. All
/// planes.
/// @param count  the others are as they are
[[nodiscard]] Result<std::vector<Picture>> solve_patterns(Segment& segment, const SegmentPatterns& patterns,
                                                          std::size_t count, const SolverSettings& settings);

}  // namespace fbs
