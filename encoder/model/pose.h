// Head pose in continuous numbers, radians and pixels. The stream's integers are HeadPose and State.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/state.h"
#include "decoder/head/head_projection.h"

namespace fbs {

/// Units of positions in State and on the decoder's screen, per pixel.
inline constexpr double kStateUnitsPerPixel = 1 << kScreenOneLog2;

/// Frame and order of rotation as in HeadPose.
struct Pose {
  double pitch = 0, yaw = 0, roll = 0;  ///< rad
  glm::dvec2 shift{0, 0};               ///< the head frame's origin in the picture, pixels
  double log2_scale = 5;                ///< log2 of the eye distance in pixels

  [[nodiscard]] double eye_distance_px() const;
};

/// screen = matrix * p + shift, with p in head units and screen in pixels.
struct PoseProjection {
  glm::dmat3 matrix;  ///< rotation times scale; row 2 gives depth
  glm::dvec2 shift;

  explicit PoseProjection(const Pose& pose);
  [[nodiscard]] glm::dvec2 operator()(glm::dvec3 p) const { return glm::dvec2(matrix * p) + shift; }
};

/// The six numbers of the pose in the units of State::pose.
[[nodiscard]] std::array<double, kPoseCount> numbers_of(const Pose& pose);
[[nodiscard]] Pose pose_of(const State& state);

}  // namespace fbs
