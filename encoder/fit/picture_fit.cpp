#include "encoder/fit/picture_fit.h"

#include <algorithm>
#include <cmath>

#include "encoder/fit/fit_tuning.h"

namespace fbs {
namespace {

bool inner_lips_strayed(const Fit& fit) {
  const Feature& inner = feature(FeatureId::kMouthInner);
  const auto first = fit.offsets.begin() + inner.first_control;
  return std::any_of(first, first + inner.control_count, [](const glm::dvec2& o) {
    return std::hypot(o.x, o.y) > kInnerLipsStray * kUnitsPerEyeDistance;
  });
}

}  // namespace

PictureFit::PictureFit(const Setup& setup, const Geometry& geometry, const SeenPattern& pattern)
    : comparison_(Comparison::with(setup, geometry, pattern)),
      lids_(geometry, comparison_.points),
      gaze_(comparison_.points) {}

void PictureFit::set_pattern(const SeenPattern& pattern) {
  comparison_.pattern = PatternSamples(comparison_.points, comparison_.geometry, pattern);
}

Fit PictureFit::with_best_eyes(const Fit& start) const {
  const Fit shut = lids_.best(comparison_, start), fit = gaze_.best(comparison_, shut);
  return fit.offsets == shut.offsets ? fit : lids_.best(comparison_, fit);
}

std::vector<FitStart> PictureFit::starts_of(const Fit& tracked) {
  std::vector<FitStart> starts = {{tracked}};
  if (inner_lips_strayed(tracked)) {
    const Feature& inner = feature(FeatureId::kMouthInner);
    starts.push_back({tracked});
    std::fill_n(starts.back().fit.offsets.begin() + inner.first_control, inner.control_count, glm::dvec2(0));
  }
  return starts;
}

PictureCost PictureFit::cost_at(const Fit& fit) const {
  NormalEquations normal(comparison_.columns.count());
  const double constant = add_picture(comparison_, 0, fit, normal);
  return cost_of(fit, constant, normal);
}

PictureCost PictureFit::cost_near(const Fit& start) const {
  GaussNewtonStep step = gauss_newton_step(comparison_, start);
  const auto stays = [](double from, double to) { return std::abs(to - from) <= kMaxLightStep; };
  if (!std::ranges::equal(start.light, step.fit.light, stays)) step.fit = start;
  return cost_of(step.fit, step.difference, step.picture);
}

PictureCost PictureFit::cost_of(const Fit& fit, double constant, NormalEquations& picture) const {
  const cv::Mat1d all = picture.symmetric();
  const std::vector<int> number = comparison_.columns.numbers();
  cv::Mat1d own(kFitNumbers, kFitNumbers, 0.0);
  for (int i = 0; i < all.rows; ++i)
    for (int j = 0; j < all.cols; ++j) own(number[i], number[j]) = all(i, j);
  // add_picture() weighs by the residual sigma and counts points, each of which represents this many samples;
  // points of small triangles represent fewer, so that the quadratic is some 25 % too large for a pattern
  // seen at rest. Lambda was tuned with that.
  const double scale = comparison_.picture.scale(0);
  const double samples = kFitPointSpacing * kFitPointSpacing / (scale * scale);
  return fbs::cost_of(fit, comparison_.pattern.index(), constant,
                      cv::Mat1d(own * samples * kResidualSigma * kResidualSigma));
}

}  // namespace fbs
