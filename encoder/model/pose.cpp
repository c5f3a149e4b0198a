#include "encoder/model/pose.h"

#include <cmath>
#include <numbers>

namespace fbs {
namespace {

constexpr double kAngleUnit = 2 * std::numbers::pi / 65536;  // rad
constexpr double kLogScaleOne = 4096;                        // of State::pose, per octave

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

std::array<double, kPoseCount> numbers_of(const Pose& pose) {
  return {pose.pitch / kAngleUnit,
          pose.yaw / kAngleUnit,
          pose.roll / kAngleUnit,
          pose.shift.x * kStateUnitsPerPixel,
          pose.shift.y * kStateUnitsPerPixel,
          pose.log2_scale * kLogScaleOne};
}

Pose pose_of(const State& state) {
  const auto& p = state.pose;
  return {p[kPitch] * kAngleUnit,
          p[kYaw] * kAngleUnit,
          p[kRoll] * kAngleUnit,
          {p[kShiftX] / kStateUnitsPerPixel, p[kShiftY] / kStateUnitsPerPixel},
          p[kLogScale] / kLogScaleOne};
}

}  // namespace fbs
