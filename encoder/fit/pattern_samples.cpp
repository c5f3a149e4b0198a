#include "encoder/fit/pattern_samples.h"

#include "decoder/head/head_deformation.h"
#include "decoder/head/mouth_interior.h"

namespace fbs {

PatternSamples::PatternSamples(const SamplePoints& points, const Geometry& geometry,
                               const SeenPattern& pattern)
    : mouth_gap_(fbs::mouth_gap(deform(geometry.positions, pattern.seen))),
      interior_opacity_(pattern.interior_opacity),
      index_(pattern.index) {
  const Fit seen = fit_of(pattern.seen);
  light_ = seen.light;
  interior_ = seen.interior;
  const PlacedHead head(geometry, seen);
  const LumaPyramid pyramid(pattern.frame);
  for (int level = 0; level < kFitLevels; ++level) {
    luma_[level].reserve(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
      Sample s;
      luma_[level].push_back(pyramid.sample(level, head(points[k]), s) ? s.value : -1.0F);
    }
  }
}

}  // namespace fbs
