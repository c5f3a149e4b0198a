// Blends of a segment's pictures: chooses modes for given patterns, and solves for patterns in given modes.
// Results are the same for any number of workers.
#pragma once

#include <vector>

#include "encoder/blend/mode_errors.h"
#include "encoder/blend/pattern_solver.h"
#include "encoder/segment/segment.h"

namespace fbs {

/// Patterns available in each picture of the segment, by group.
struct SegmentPatterns {
  BlendScene scene;
  std::vector<AvailablePatterns> available;  ///< of each group
};

/// Distortion of blend modes. Luma only, at a reduced size.
struct SegmentErrors {
  /// Consecutive pictures, represented by the first.
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

/// @param most  longest run, pictures; never across a cut
[[nodiscard]] Result<SegmentErrors> mode_errors(const Segment& segment, const SegmentPatterns& patterns,
                                                std::size_t most, Workers& workers);

/// Luma error of the segment in its cheapest modes, mean over samples, from one of `every` pictures.
[[nodiscard]] Result<double> blend_loss(const Segment& segment, const SegmentPatterns& patterns,
                                        std::size_t every, Workers& workers);

/// Pictures that, coded as the last `count` patterns, draw the segment best in the modes of its states. All
/// planes.
/// @param count  the others stay unchanged
[[nodiscard]] Result<std::vector<Picture>> solve_patterns(const Segment& segment,
                                                          const SegmentPatterns& patterns, std::size_t count,
                                                          const SolverSettings& settings, Workers& workers);

}  // namespace fbs
