// The points that a few control points move, at which a search compares its candidates.
#pragma once

#include <vector>

#include "encoder/fit/comparison.h"

namespace fbs {

/// Sample points that move with consecutive control points.
class MovedPoints {
 public:
  MovedPoints(const SamplePoints& points, std::size_t first_control, std::size_t count);

  /// Mean robust squared difference between pattern and picture over the points, by area in the picture.
  /// @param comparison  over the same sample points
  [[nodiscard]] double difference(const Comparison& comparison, const Fit& fit) const;

 private:
  /// The moved points of one triangle.
  struct Patch {
    std::size_t patch;  ///< index into SamplePoints::patches()
    std::vector<std::size_t> points;
  };
  std::vector<Patch> patches_;
};

}  // namespace fbs
