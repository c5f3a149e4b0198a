// HeadProjection in doubles: what the decoder's integers are compared with.
#pragma once

#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <numbers>

#include "decoder/head/head_projection.h"

namespace fbs {

/// Roll * yaw * pitch, each the usual right-handed matrix.
struct PlainProjection {
  glm::dmat3 rotation;
  double scale;  ///< pixels per head unit
  glm::dvec2 shift;

  explicit PlainProjection(const HeadPose& pose)
      : rotation(about(2, pose.roll * kAngleUnit) * about(1, pose.yaw * kAngleUnit) *
                 about(0, pose.pitch * kAngleUnit)),
        scale(std::exp2(pose.log_scale / 4096.0) / kUnitsPerEyeDistance),
        shift(pose.shift_x / 64.0, pose.shift_y / 64.0) {}

  /// Pixels.
  [[nodiscard]] glm::dvec2 operator()(glm::dvec3 p) const { return glm::dvec2(rotation * p) * scale + shift; }

 private:
  static constexpr double kAngleUnit = 2 * std::numbers::pi / 65536;

  static glm::dmat3 about(int axis, double angle) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    glm::dmat3 m(1);  // m[column][row]
    m[i][i] = m[j][j] = std::cos(angle);
    m[i][j] = std::sin(angle);
    m[j][i] = -std::sin(angle);
    return m;
  }
};

}  // namespace fbs
