// Finds the gaze by a search: eyes jump to another place within a picture or two, farther than a descent
// reaches.
#pragma once

#include <array>

#include "encoder/fit/comparison.h"
#include "encoder/fit/moved_points.h"

namespace fbs {

class GazeSearch {
 public:
  explicit GazeSearch(const SamplePoints& points);

  /// `start` with both pupils where pattern and picture agree best: where they are, or moved alike from rest
  /// to one of several places.
  /// @param comparison  over the same points
  [[nodiscard]] Fit best(const Comparison& comparison, const Fit& start) const;

 private:
  std::array<MovedPoints, 2> eyes_;
};

}  // namespace fbs
