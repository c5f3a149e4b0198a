#include "encoder/fit/fit_priors.h"

#include "encoder/fit/fit_tuning.h"
#include "encoder/model/expression_prior.h"

namespace fbs {
namespace {

bool belongs_to(std::size_t control, FeatureId first, FeatureId last) {
  const Feature &from = feature(first), &to = feature(last);
  return control >= from.first_control &&
         control < static_cast<std::size_t>(to.first_control) + to.control_count;
}

/// Sigma of a control point about its place in a start, eye distances.
double sigma_of(std::size_t control, double lips) {
  if (belongs_to(control, FeatureId::kMouthOuter, FeatureId::kMouthOuter)) return lips * kOuterLipSigma;
  if (belongs_to(control, FeatureId::kMouthInner, FeatureId::kMouthInner)) return lips * kInnerLipSigma;
  if (belongs_to(control, FeatureId::kBrowRight, FeatureId::kBrowLeft)) return kBrowSigma;
  if (belongs_to(control, FeatureId::kUpperLidRight, FeatureId::kUpperLidLeft)) return kLidSigma;
  return kOtherSigma;
}

/// Sigma of a control point about rest, eye distances.
double rest_sigma_of(std::size_t control) {
  return belongs_to(control, FeatureId::kPupilRight, FeatureId::kPupilLeft) ? kGazeRestSigma : kLidRestSigma;
}

void add_pose(const Pose& start, const Pose& pose, NormalEquations& normal) {
  const double shift_sigma = kPoseSigma * pose.eye_distance_px();
  normal.add_prior(0, pose.pitch - start.pitch, kPoseSigma);
  normal.add_prior(1, pose.yaw - start.yaw, kPoseSigma);
  normal.add_prior(2, pose.roll - start.roll, kPoseSigma);
  normal.add_prior(3, pose.shift.x - start.shift.x, shift_sigma);
  normal.add_prior(4, pose.shift.y - start.shift.y, shift_sigma);
  normal.add_prior(5, pose.log2_scale - start.log2_scale, kPoseSigma);
}

void add_light(const Fit& start, const Fit& fit, NormalEquations& normal) {
  for (std::size_t i = 0; i < kLightCount; ++i) {
    normal.add_prior(FitColumns::kFirstLight + i, fit.light[i] - start.light[i], kLightSigma);
    normal.add_prior(FitColumns::kFirstLight + i, fit.light[i], kLightRestSigma);
  }
  for (std::size_t i = 0; i < kInteriorCount; ++i) {
    normal.add_prior(FitColumns::kFirstInterior + i, fit.interior[i] - start.interior[i], kInteriorSigma);
    normal.add_prior(FitColumns::kFirstInterior + i, fit.interior[i], kInteriorRestSigma);
  }
}

void add_controls(const FitColumns& columns, const FitStart& start, const Fit& fit, NormalEquations& normal) {
  for (std::size_t c = 0; c < kControlCount; ++c) {
    if (!columns.has(c)) continue;
    for (int axis = 0; axis < 2; ++axis) {
      const std::size_t k = columns.of(c) + static_cast<std::size_t>(axis);
      normal.add_prior(k, fit.offsets[c][axis] - start.fit.offsets[c][axis],
                       sigma_of(c, start.lips) * kUnitsPerEyeDistance);
      if (c >= kExpressionControls)
        normal.add_prior(k, fit.offsets[c][axis], rest_sigma_of(c) * kUnitsPerEyeDistance);
    }
  }
}

/// Lips and brows: the expression prior, joint over all their control points.
void add_expression(const FitColumns& columns, const Fit& fit, NormalEquations& normal) {
  const cv::Mat1d& expression = expression_precision();
  for (std::size_t i = 0; i < 2 * kExpressionControls; ++i) {
    if (!columns.has(i / 2)) continue;
    const std::size_t k = columns.of(i / 2) + i % 2;
    for (std::size_t j = 0; j < 2 * kExpressionControls; ++j) {
      if (!columns.has(j / 2)) continue;
      const std::size_t l = columns.of(j / 2) + j % 2;
      const double p = expression(static_cast<int>(i), static_cast<int>(j)) /
                       (static_cast<double>(kUnitsPerEyeDistance) * kUnitsPerEyeDistance);
      if (k <= l) normal.left(k, l) += p;
      normal.right(k) -= p * fit.offsets[j / 2][static_cast<int>(j % 2)];
    }
  }
}

/// Makes both eyes look the same way. Each alone finds shadows and lashes as dark as a pupil.
void add_gaze(const FitColumns& columns, const Fit& fit, NormalEquations& normal) {
  constexpr double kSigma = kGazeSigma * kUnitsPerEyeDistance, kPrecision = 1 / (kSigma * kSigma);
  const std::size_t right = feature(FeatureId::kPupilRight).first_control,
                    left = feature(FeatureId::kPupilLeft).first_control;
  if (!columns.has(right) || !columns.has(left)) return;
  for (int axis = 0; axis < 2; ++axis) {
    const std::size_t r = columns.of(right) + static_cast<std::size_t>(axis),
                      l = columns.of(left) + static_cast<std::size_t>(axis);
    const double apart = fit.offsets[left][axis] - fit.offsets[right][axis];
    normal.left(r, r) += kPrecision;
    normal.left(l, l) += kPrecision;
    normal.left(std::min(r, l), std::max(r, l)) -= kPrecision;
    normal.right(r) += kPrecision * apart;
    normal.right(l) -= kPrecision * apart;
  }
}

}  // namespace

void add_priors(const FitColumns& columns, const FitStart& start, const Fit& fit, NormalEquations& normal) {
  add_pose(start.fit.pose, fit.pose, normal);
  add_light(start.fit, fit, normal);
  add_controls(columns, start, fit, normal);
  add_expression(columns, fit, normal);
  add_gaze(columns, fit, normal);
}

}  // namespace fbs
