#include "encoder/fit/gauss_newton.h"

#include <algorithm>

#include "encoder/model/pose_jacobian.h"

namespace fbs {
namespace {

/// Where a control point may be, head units from rest.
struct Bounds {
  glm::dvec2 least, most;
};

Bounds bounds_of(std::size_t control) {
  for (const FeatureId id : {FeatureId::kPupilRight, FeatureId::kPupilLeft})
    if (control == feature(id).first_control) return {{-kMaxGazeX, -kMaxGazeY}, {kMaxGazeX, kMaxGazeY}};
  if (control < feature(FeatureId::kBrowRight).first_control)
    return {glm::dvec2(-kMaxLipOffset), glm::dvec2(kMaxLipOffset)};
  const std::size_t lids = feature(FeatureId::kUpperLidRight).first_control,
                    behind = feature(FeatureId::kLowerLidRight).first_control;
  return {{-kMaxOffset, control >= lids && control < behind ? -kMaxLidRise : -kMaxOffset},
          glm::dvec2(kMaxOffset)};
}

/// @param x  the unknowns' steps
void add_step(const FitColumns& columns, const cv::Mat1d& x, Fit& fit) {
  fit.pose = moved(fit.pose, {x(0), x(1), x(2), x(3), x(4), x(5)});
  for (std::size_t i = 0; i < kLightCount; ++i)
    fit.light[i] += x(static_cast<int>(FitColumns::kFirstLight + i));
  for (std::size_t i = 0; i < kInteriorCount; ++i)
    fit.interior[i] += x(static_cast<int>(FitColumns::kFirstInterior + i));
  for (std::size_t c = 0; c < kControlCount; ++c) {
    if (!columns.has(c)) continue;
    const int column = static_cast<int>(columns.of(c));
    const auto [least, most] = bounds_of(c);
    fit.offsets[c] = glm::clamp(fit.offsets[c] + glm::dvec2(x(column), x(column + 1)), least, most);
  }
}

/// @param start  the start of `fit`
/// @return whether the equations could be solved
bool descend(const Comparison& comparison, int level, const FitStart& start, Fit& fit) {
  for (int i = 0; i < kStepsOfLevel[level]; ++i) {
    NormalEquations normal(comparison.columns.count());
    add_priors(comparison.columns, start, fit, normal);
    add_picture(comparison, level, fit, normal);
    const auto x = normal.solve();
    if (!x) return false;
    add_step(comparison.columns, *x, fit);
  }
  return true;
}

}  // namespace

CoarseFit coarse_fit(const Comparison& comparison, const FitStart& start) {
  Fit fit = start.fit;
  for (int level = kFitLevels - 1; level > 0; --level)
    if (!descend(comparison, level, start, fit)) fit = start.fit;
  return {start, fit, start.counts * mean_difference(comparison, fit)};
}

BestFit fine_fit(const Comparison& comparison, std::span<const CoarseFit> starts) {
  const auto nearest = std::ranges::min_element(starts, {}, &CoarseFit::difference);
  BestFit best{nearest->fit, static_cast<std::size_t>(nearest - starts.begin())};
  if (!descend(comparison, 0, nearest->start, best.fit) ||
      mean_difference(comparison, best.fit) >= mean_difference(comparison, nearest->start.fit))
    best.fit = nearest->start.fit;
  return best;
}

GaussNewtonStep gauss_newton_step(const Comparison& comparison, const Fit& start) {
  GaussNewtonStep out{start, 0, NormalEquations(comparison.columns.count())};
  out.difference = add_picture(comparison, 0, start, out.picture);
  NormalEquations normal = out.picture;
  add_priors(comparison.columns, {start}, start, normal);
  if (const auto x = normal.solve()) add_step(comparison.columns, *x, out.fit);
  return out;
}

}  // namespace fbs
