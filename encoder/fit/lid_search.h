// Where the upper lids are: a search, since a blink is over in three pictures, too fast for a descent.
#pragma once

#include <array>
#include <vector>

#include "encoder/fit/comparison.h"

namespace fbs {

class LidSearch {
 public:
  LidSearch(const Geometry& geometry, const SamplePoints& points);

  /// `start` with the upper lids where the pattern, smeared on the closing eyes, is nearest to the picture:
  /// where they are, wider, or shut by some fifths, both eyes alike unless the picture insists.
  /// @param comparison  over the same points
  [[nodiscard]] Fit best(const Comparison& comparison, const Fit& start) const;

 private:
  /// Those points of a triangle that a lid moves.
  struct MovedPoints {
    std::size_t patch;  ///< index into SamplePoints::patches()
    std::vector<std::size_t> points;
  };

  /// An upper lid: its control points and how far they go down to shut the eye, and what it moves.
  struct Lid {
    std::size_t first_control = 0;
    double travel = 0;  ///< head units
    std::vector<MovedPoints> moved;

    /// `start` with this lid as candidate `i` of the search has it; the last leaves it as it is.
    [[nodiscard]] Fit closed(std::size_t candidate, Fit start) const;
    /// 0 at rest, 1 shut.
    [[nodiscard]] double closing(const Fit& fit) const;
  };

  /// @param control  the first of two
  [[nodiscard]] static std::vector<MovedPoints> moved_by(const SamplePoints& points, std::size_t control);
  [[nodiscard]] static Lid lid_of(const Geometry& geometry, const SamplePoints& points, FeatureId id,
                                  std::size_t lower_landmark);
  /// Mean robust squared difference over what a lid moves, by area in the picture.
  [[nodiscard]] static double difference(const Comparison& comparison, const Lid& lid, const Fit& fit);

  std::array<Lid, 2> lids_;
};

}  // namespace fbs
