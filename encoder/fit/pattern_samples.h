// A pattern at the sample points, and what of a face it already shows.
#pragma once

#include <array>
#include <vector>

#include "encoder/fit/luma_pyramid.h"
#include "encoder/fit/sample_points.h"

namespace fbs {

/// A picture that others are drawn from, and the state in which it was seen.
struct SeenPattern {
  const WorkFrame& frame;  ///< of the decoded picture
  const State& seen;
  int index = 0;                ///< among the stream's patterns
  double interior_opacity = 0;  ///< 0..1, of the state's mouth interior where the picture was drawn with one
};

/// Luma where the mesh lay in the seen state, its expression included, without the light of that state; and
/// the mouth opening that is in it.
class PatternSamples {
 public:
  PatternSamples(const SamplePoints& points, const Geometry& geometry, const SeenPattern& pattern);

  /// Negative where the frame does not reach.
  [[nodiscard]] float luma(int level, std::size_t point) const { return luma_[level][point]; }
  /// As mouth_gap() of the decoder gives it, head units.
  [[nodiscard]] std::int32_t mouth_gap() const { return mouth_gap_; }
  /// Of the mouth interior that the pattern shows, 0..1, and what that adds to its colours, grey levels.
  [[nodiscard]] double interior_opacity() const { return interior_opacity_; }
  [[nodiscard]] const std::array<double, kInteriorCount>& interior() const { return interior_; }
  [[nodiscard]] int index() const { return index_; }

 private:
  std::array<std::vector<float>, kFitLevels> luma_;
  std::array<double, kInteriorCount> interior_;
  std::int32_t mouth_gap_;
  double interior_opacity_;
  int index_;
};

}  // namespace fbs
