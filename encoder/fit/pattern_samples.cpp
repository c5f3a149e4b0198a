#include "encoder/fit/pattern_samples.h"

#include <algorithm>

#include "decoder/head/head_deformation.h"
#include "decoder/head/mouth_interior.h"

namespace fbs {

namespace {

/// Luma of a pattern before its light: SPEC 10.11. Never negative, which means no luma.
/// @param basis  SamplePoints::light()
float unlit(float luma, const Fit& seen, const std::array<double, kLightCount>& basis) {
  double offset = 0;
  for (std::size_t i = 0; i < kLightCount; ++i)
    if (i != kLightGain) offset += seen.light[i] * basis[i];
  const double factor = std::max(1 + seen.light[kLightGain] / kGainLevels, kLeastGainFactor);
  return static_cast<float>(std::clamp(128 + (luma - 128 - offset) / factor, 0.0, 255.0));
}

}  // namespace

PatternSamples::PatternSamples(const SamplePoints& points, const Geometry& geometry,
                               const SeenPattern& pattern)
    : mouth_gap_(fbs::mouth_gap(geometry, pattern.seen)),
      interior_opacity_(pattern.interior_opacity),
      index_(pattern.index) {
  const Fit seen = fit_of(pattern.seen);
  interior_ = seen.interior;
  const PlacedHead head(geometry, seen);
  const LumaPyramid pyramid(pattern.frame, pattern.levels);
  for (int level = 0; level < pattern.levels; ++level) {
    luma_[level].reserve(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
      Sample s;
      luma_[level].push_back(pyramid.sample(level, head(points[k]), s) ? unlit(s.value, seen, points.light(k))
                                                                       : -1.0F);
    }
  }
}

}  // namespace fbs
