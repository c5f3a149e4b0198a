// A pattern at the sample points, and what it already shows of a face.
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
  double interior_opacity = 0;  ///< 0..1; of the mouth interior where the picture was drawn with one
  int levels = kFitLevels;      ///< at which pictures are compared with it, the finest first
};

/// Luma at the mesh's position in the seen state, its expression included, without that state's light; and
/// the mouth opening of that state.
class PatternSamples {
 public:
  PatternSamples(const SamplePoints& points, const Geometry& geometry, const SeenPattern& pattern);

  /// Negative outside the frame.
  [[nodiscard]] float luma(int level, std::size_t point) const { return luma_[level][point]; }
  /// The decoder's mouth_gap(), head units.
  [[nodiscard]] std::int32_t mouth_gap() const { return mouth_gap_; }
  /// Opacity of the mouth interior in the pattern, 0..1, and its addition to the interior's colours, grey
  /// levels.
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
