// What aligning the head's surface with a picture needs, whoever does it: points on the mesh, the picture's
// value and slope, and how a projected point moves with the pose.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <opencv2/core.hpp>
#include <vector>

#include "encoder/pose.h"

namespace fbs {

using HeadVertices = std::array<glm::dvec3, kVertexCount>;  ///< head units

/// A point fixed on a triangle of the mesh.
struct SurfacePoint {
  std::int16_t triangle;
  std::array<std::int16_t, 3> corner;
  std::array<float, 3> barycentric;

  [[nodiscard]] glm::dvec3 on(const HeadVertices& v) const {
    return static_cast<double>(barycentric[0]) * v[static_cast<std::size_t>(corner[0])] +
           static_cast<double>(barycentric[1]) * v[static_cast<std::size_t>(corner[1])] +
           static_cast<double>(barycentric[2]) * v[static_cast<std::size_t>(corner[2])];
  }
};

/// Points spread evenly over the mesh as `projection` sees it.
/// @param spacing_px  between neighbours, pixels of the picture
/// @param mouth_rows  points across each triangle of the mouth's inside at least, which may be a mere line
/// now
[[nodiscard]] std::vector<SurfacePoint> spread_over_mesh(const HeadVertices& vertices,
                                                         const PoseProjection& projection, double spacing_px,
                                                         int mouth_rows = 1);

/// Bilinear value and central-difference slope of an 8-bit picture.
struct Sample {
  double value = 0, dx = 0, dy = 0;
};
/// @return false within two pixels of the border and outside
[[nodiscard]] bool sample_with_slope(const cv::Mat& picture, glm::dvec2 at, Sample& out);

/// Pose with six numbers added: pitch, yaw, roll (rad), shift x and y (px), log2 scale; turns are kept within
/// what still shows a face.
using PoseStep = cv::Vec<double, 6>;
[[nodiscard]] Pose moved(const Pose& pose, const PoseStep& step);

/// Derivatives of a projected point by the six numbers of PoseStep: the rotations' by difference, the rest
/// exact.
class PoseJacobian {
 public:
  explicit PoseJacobian(const Pose& pose);
  [[nodiscard]] const PoseProjection& projection() const { return projection_; }
  /// Pixels per unit of each number.
  [[nodiscard]] std::array<glm::dvec2, 6> at(glm::dvec3 p) const;

 private:
  PoseProjection projection_;
  std::array<glm::dmat3, 3> by_angle_;
};

}  // namespace fbs
