#include "encoder/model/fit.h"

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
  for (const double light : fit.light) *to++ = 16 * light;
  for (const double inside : fit.interior) *to++ = 16 * inside;
  const auto expression = to_coefficients(fit.offsets);
  std::copy(expression.begin(), expression.end(), out.begin() + kFirstCoefficient);
  return out;
}

}  // namespace

State state_of(const Fit& fit) {
  State state;
  const auto whole = [](double v) { return static_cast<std::int32_t>(std::lround(v)); };
  const auto pose = numbers_of(fit.pose);
  std::transform(pose.begin(), pose.end(), state.pose.begin(), whole);
  for (std::size_t i = 0; i < kLightCount; ++i) state.light[i] = whole(16 * fit.light[i]);
  for (std::size_t i = 0; i < kInteriorCount; ++i) state.interior[i] = whole(16 * fit.interior[i]);
  for (std::size_t c = 0; c < kControlCount; ++c)
    state.control[c] = {whole(fit.offsets[c].x), whole(fit.offsets[c].y)};
  return state;
}

FitForm form_unseen(const Fit& fit) {
  // The pose stays rather than to slide to where the face comes back: as if a few samples said so.
  constexpr double kSamples = 4;
  const Pose unit = one_unit();
  const double eye = fit.pose.eye_distance_px();
  const std::array<double, kPoseCount> px = {unit.pitch * eye, unit.yaw * eye,
                                             unit.roll * eye,  unit.shift.x,
                                             unit.shift.y,     unit.log2_scale * eye * std::numbers::ln2};
  FitForm out{values_of(fit), cv::Mat1d::zeros(kParameterCount, kParameterCount)};
  for (int i = 0; i < kPoseCount; ++i) out.form(i, i) = kSamples * px[i] * px[i];
  return out;
}

FitForm form_of(const Fit& fit, const cv::Mat1d& fitted) {
  const Pose p = one_unit();
  std::array<double, kFitOffsets> unit = {p.pitch, p.yaw, p.roll, p.shift.x, p.shift.y, p.log2_scale};
  std::fill(unit.begin() + kPoseCount, unit.end(), 1 / 16.0);
  cv::Mat1d own = fitted.clone();
  for (int i = 0; i < kFitOffsets; ++i) {
    own.row(i) *= unit[i];
    own.col(i) *= unit[i];
  }
  const cv::Range ours(0, kFitOffsets), offsets(kFitOffsets, kFitNumbers);
  const cv::Range coefficients(kFirstCoefficient, kParameterCount);
  const cv::Mat1d across = rows_of_coefficients(cv::Mat1d(own(ours, offsets)));
  FitForm out{values_of(fit), cv::Mat1d::zeros(kParameterCount, kParameterCount)};
  own(ours, ours).copyTo(out.form(ours, ours));
  across.copyTo(out.form(ours, coefficients));
  cv::Mat(across.t()).copyTo(out.form(coefficients, ours));
  form_of_coefficients(cv::Mat1d(own(offsets, offsets))).copyTo(out.form(coefficients, coefficients));
  return out;
}

}  // namespace fbs
