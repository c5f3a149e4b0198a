// Derivatives of a projected point by the pose.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <opencv2/core.hpp>

#include "encoder/model/pose.h"

namespace fbs {

/// Six numbers to add to a pose: pitch, yaw, roll (rad), shift x and y (px), log2 scale; the sum's angles are
/// clamped to what still shows a face.
using PoseStep = cv::Vec<double, 6>;
[[nodiscard]] Pose moved(const Pose& pose, const PoseStep& step);

/// Derivatives of a projected point by the six numbers of PoseStep: finite differences for the angles, exact
/// for the rest.
class PoseJacobian {
 public:
  explicit PoseJacobian(const Pose& pose);
  [[nodiscard]] const PoseProjection& projection() const { return projection_; }
  /// Pixels per unit of each number.
  [[nodiscard]] std::array<glm::dvec2, 6> at(glm::dvec3 p) const {
    return {glm::dvec2(by_angle_[0] * p),
            glm::dvec2(by_angle_[1] * p),
            glm::dvec2(by_angle_[2] * p),
            {1, 0},
            {0, 1},
            std::numbers::ln2 * glm::dvec2(projection_.matrix * p)};
  }

 private:
  PoseProjection projection_;
  std::array<glm::dmat3, 3> by_angle_;
};

}  // namespace fbs
