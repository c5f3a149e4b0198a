// Finds the upper lids by a search: a blink is over in three pictures, too fast for a descent.
#pragma once

#include <array>

#include "encoder/fit/comparison.h"
#include "encoder/fit/moved_points.h"

namespace fbs {

class LidSearch {
 public:
  LidSearch(const Geometry& geometry, const SamplePoints& points);

  /// `start` with the upper lids where the pattern, smeared over the closing eyes, is nearest to the picture:
  /// unchanged, wider, or shut by some fifths, both eyes alike unless the picture insists.
  /// @param comparison  over the same points
  [[nodiscard]] Fit best(const Comparison& comparison, const Fit& start) const;

 private:
  /// An upper lid: its control points, their travel to shut the eye, and the points it moves.
  struct Lid {
    std::size_t first_control;
    double travel;  ///< head units
    MovedPoints moved;

    /// `start` with this lid as in candidate `i` of the search; the last leaves it unchanged.
    [[nodiscard]] Fit closed(std::size_t candidate, Fit start) const;
    /// 0 at rest, 1 shut.
    [[nodiscard]] double closing(const Fit& fit) const;
  };

  [[nodiscard]] static Lid lid_of(const Geometry& geometry, const SamplePoints& points, FeatureId id,
                                  std::size_t lower_landmark);

  std::array<Lid, 2> lids_;
};

}  // namespace fbs
