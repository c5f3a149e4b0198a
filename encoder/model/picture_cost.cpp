#include "encoder/model/picture_cost.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fbs {
namespace {

/// One unit of each number of State::pose.
Pose one_unit() {
  State one;
  one.pose.fill(1);
  return pose_of(one);
}

std::array<double, kParameterCount> values_of(const Fit& fit) {
  std::array<double, kParameterCount> out{};
  const auto pose = numbers_of(fit.pose);
  auto to = std::copy(pose.begin(), pose.end(), out.begin());
  for (const double light : fit.light) *to++ = kLightUnitsPerLevel * light;
  for (const double level : fit.interior) *to++ = kLightUnitsPerLevel * level;
  const auto expression = to_coefficients(fit.offsets);
  std::copy(expression.begin(), expression.end(), out.begin() + kFirstCoefficient);
  return out;
}

}  // namespace

cv::Mat1d PictureCost::quadratic() const {
  cv::Mat1d sum(kParameterCount, kParameterCount, 0.0);
  for (const LayerCost& r : layers) sum += r.quadratic;
  return sum;
}

double PictureCost::constant() const {
  double sum = 0;
  for (const LayerCost& r : layers) sum += r.constant;
  return sum;
}

PictureCost cost_unseen(const Fit& fit) {
  // Holds the pose, which would otherwise slide to where the face comes back.
  constexpr double kSamples = 4;  // weight: as many samples with a slope of one level per pixel
  const Pose unit = one_unit();
  const double eye = fit.pose.eye_distance_px();
  const std::array<double, kPoseCount> px = {unit.pitch * eye, unit.yaw * eye,
                                             unit.roll * eye,  unit.shift.x,
                                             unit.shift.y,     unit.log2_scale * eye * std::numbers::ln2};
  cv::Mat1d quadratic(kParameterCount, kParameterCount, 0.0);
  for (int i = 0; i < kPoseCount; ++i) quadratic(i, i) = kSamples * px[i] * px[i];
  return {values_of(fit), {{CostLayer::kHead, 0, 0, quadratic}}};
}

PictureCost cost_of(const Fit& fit, int pattern, double constant, const cv::Mat1d& own) {
  const Pose p = one_unit();
  std::array<double, kFitOffsets> unit = {p.pitch, p.yaw, p.roll, p.shift.x, p.shift.y, p.log2_scale};
  std::fill(unit.begin() + kPoseCount, unit.end(), 1 / kLightUnitsPerLevel);
  cv::Mat1d scaled = own.clone();
  for (int i = 0; i < kFitOffsets; ++i) {
    scaled.row(i) *= unit[i];
    scaled.col(i) *= unit[i];
  }
  const cv::Range ours(0, kFitOffsets), offsets(kFitOffsets, kFitNumbers);
  const cv::Range coefficients(kFirstCoefficient, kParameterCount);
  const cv::Mat1d across = rows_of_coefficients(cv::Mat1d(scaled(ours, offsets)));
  cv::Mat1d quadratic(kParameterCount, kParameterCount, 0.0);
  scaled(ours, ours).copyTo(quadratic(ours, ours));
  across.copyTo(quadratic(ours, coefficients));
  cv::Mat(across.t()).copyTo(quadratic(coefficients, ours));
  quadratic_of_coefficients(cv::Mat1d(scaled(offsets, offsets)))
      .copyTo(quadratic(coefficients, coefficients));
  return {values_of(fit), {{CostLayer::kHead, pattern, constant, quadratic}}};
}

}  // namespace fbs
