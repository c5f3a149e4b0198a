#include "encoder/model/pose_jacobian.h"

#include <algorithm>
#include <cmath>

namespace fbs {

Pose moved(const Pose& pose, const PoseStep& step) {
  Pose out = pose;
  out.pitch += step[0];
  out.yaw += step[1];
  out.roll += step[2];
  out.shift += glm::dvec2(step[3], step[4]);
  out.log2_scale += step[5];
  constexpr double kMaxAngle = 1.2;  // rad; beyond it the face is out of sight
  out.pitch = std::clamp(out.pitch, -kMaxAngle, kMaxAngle);
  out.yaw = std::clamp(out.yaw, -kMaxAngle, kMaxAngle);
  out.roll = std::clamp(out.roll, -kMaxAngle, kMaxAngle);
  return out;
}

PoseJacobian::PoseJacobian(const Pose& pose) : projection_(pose) {
  constexpr double kStep = 1e-4;
  for (int k = 0; k < 3; ++k) {
    PoseStep d;
    d[k] = kStep;
    by_angle_[k] = (PoseProjection(moved(pose, d)).matrix - projection_.matrix) / kStep;
  }
}

}  // namespace fbs
