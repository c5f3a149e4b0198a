// Where the upper lids are: a search, since a blink is over in three pictures, too fast for a descent.
#pragma once

#include <array>

#include "encoder/fit/comparison.h"
#include "encoder/fit/moved_points.h"

namespace fbs {

class LidSearch {
 public:
  LidSearch(const Geometry& geometry, const SamplePoints& points);

  /// `start` with the upper lids where the pattern, smeared on the closing eyes, is nearest to the picture:
  /// where they are, wider, or shut by some fifths, both eyes alike unless the picture insists.
  /// @param comparison  over the same points
  [[nodiscard]] Fit best(const Comparison& comparison, const Fit& start) const;

 private:
  /// An upper lid: its control points and how far they go down to shut the eye, and what it moves.
  struct Lid {
    std::size_t first_control;
    double travel;  ///< head units
    MovedPoints moved;

    /// `start` with this lid as candidate `i` of the search has it; the last leaves it as it is.
    [[nodiscard]] Fit closed(std::size_t candidate, Fit start) const;
    /// 0 at rest, 1 shut.
    [[nodiscard]] double closing(const Fit& fit) const;
  };

  [[nodiscard]] static Lid lid_of(const Geometry& geometry, const SamplePoints& points, FeatureId id,
                                  std::size_t lower_landmark);

  std::array<Lid, 2> lids_;
};

}  // namespace fbs
