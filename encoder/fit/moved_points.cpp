#include "encoder/fit/moved_points.h"

#include "encoder/fit/fit_tuning.h"
#include "encoder/image/robust.h"

namespace fbs {

MovedPoints::MovedPoints(const SamplePoints& points, std::size_t first_control, std::size_t count) {
  for (std::size_t n = 0; n < points.patches().size(); ++n) {
    const SamplePoints::Patch& patch = points.patches()[n];
    Patch moved{n, {}};
    const float* share = patch.shares.data();
    for (std::size_t k = patch.first; k < patch.end; ++k, share += patch.controls.size()) {
      bool any = false;
      for (std::size_t i = 0; i < patch.controls.size(); ++i)
        any = any || (patch.controls[i] >= first_control && patch.controls[i] < first_control + count &&
                      share[i] > kMinMovedShare);
      if (any) moved.points.push_back(k);
    }
    if (!moved.points.empty()) patches_.push_back(std::move(moved));
  }
}

double MovedPoints::difference(const Comparison& c, const Fit& fit) const {
  const PlacedHead head(c.geometry, fit);
  const Appearance shown = c.appearance(fit, head.vertices);
  double sum = 0, weights = 0;
  for (const Patch& patch : patches_) {
    const double weight = c.points.samples_per_point(patch.patch, head);
    if (weight <= 0) continue;
    for (const std::size_t k : patch.points) {
      const double value = shown.at(k, kSearchLevel);
      Sample s;
      if (value < 0 || !c.picture.sample(kSearchLevel, head(c.points[k]), s)) continue;
      const double r = (value - s.value) * (value - s.value);
      sum += weight * geman_mcclure(r, kSearchResidualSigma * kSearchResidualSigma);
      weights += weight;
    }
  }
  return weights > 0 ? sum / weights : 0;
}

}  // namespace fbs
