#include "encoder/pose.h"

#include <cmath>
#include <numbers>

namespace fbs {
namespace {

constexpr double kAngleUnit = 2 * std::numbers::pi / 65536;

std::int32_t to_steps(double value, double unit, std::int32_t step) {
  return static_cast<std::int32_t>(std::lround(value / (unit * step)));
}

}  // namespace

double Pose::eye_distance_px() const {
  return std::exp2(log2_scale);
}

PoseProjection::PoseProjection(const Pose& pose) : shift(pose.shift) {
  const double sp = std::sin(pose.pitch), cp = std::cos(pose.pitch);
  const double sy = std::sin(pose.yaw), cy = std::cos(pose.yaw);
  const double sr = std::sin(pose.roll), cr = std::cos(pose.roll);
  const double s = pose.eye_distance_px() / kUnitsPerEyeDistance;
  // glm is column-major: each constructor row below is one column of the matrix.
  matrix = glm::dmat3(cr * cy, sr * cy, -sy,                                    //
                      cr * sy * sp - sr * cp, sr * sy * sp + cr * cp, cy * sp,  //
                      cr * sy * cp + sr * sp, sr * sy * cp - cr * sp, cy * cp) *
           s;
}

glm::dvec2 PoseProjection::operator()(glm::dvec3 p) const {
  return glm::dvec2(matrix * p) + shift;
}

std::array<std::int32_t, kPoseCount> quantise(const Pose& pose, const QuantiserSteps& steps) {
  std::array<std::int32_t, kPoseCount> q{};
  q[kPitch] = to_steps(pose.pitch, kAngleUnit, steps.rotation);
  q[kYaw] = to_steps(pose.yaw, kAngleUnit, steps.rotation);
  q[kRoll] = to_steps(pose.roll, kAngleUnit, steps.rotation);
  q[kShiftX] = to_steps(pose.shift.x, 1.0 / 64, steps.translation);
  q[kShiftY] = to_steps(pose.shift.y, 1.0 / 64, steps.translation);
  q[kLogScale] = to_steps(pose.log2_scale, 1.0 / 4096, steps.log_scale);
  return q;
}

Pose dequantise(const State& state, const QuantiserSteps& steps) {
  const HeadPose p = dequantise_pose(state, steps);
  return {p.pitch * kAngleUnit,
          p.yaw * kAngleUnit,
          p.roll * kAngleUnit,
          {p.shift_x / 64.0, p.shift_y / 64.0},
          p.log_scale / 4096.0};
}

}  // namespace fbs
