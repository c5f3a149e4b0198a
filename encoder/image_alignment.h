// What aligning the head's surface with a picture needs, whoever does it: points on the mesh, the picture's
// value and slope, and how a projected point moves with the pose.
#pragma once

#include <array>
#include <cstdint>
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
  float value = 0, dx = 0, dy = 0;
};

/// @return false within two pixels of the border and outside
template <class Real>  // float or double
[[nodiscard]] inline bool sample_with_slope(const cv::Mat& picture, glm::vec<2, Real> at, Sample& out) {
  constexpr auto kBorder = static_cast<Real>(2.001);
  if (!(at.x >= 1 && at.y >= 1 && at.x < static_cast<Real>(picture.cols) - kBorder &&
        at.y < static_cast<Real>(picture.rows) - kBorder))
    return false;
  const int i = static_cast<int>(at.x), j = static_cast<int>(at.y);
  const auto fx = static_cast<float>(at.x - static_cast<Real>(i));
  const auto fy = static_cast<float>(at.y - static_cast<Real>(j));
  const std::size_t stride = picture.step.p[0];
  const std::uint8_t* r1 = picture.data + static_cast<std::size_t>(j) * stride + i;
  const std::uint8_t *r0 = r1 - stride, *r2 = r1 + stride, *r3 = r2 + stride;
  // Rows 1 and 2 meet in a row at the height of `at`, whose value and slope follow from four samples.
  alignas(16) float row[4], down[4];
  for (int k = 0; k < 4; ++k) {
    const auto above = static_cast<float>(r1[k - 1]), below = static_cast<float>(r2[k - 1]);
    row[k] = above + (below - above) * fy;
  }
  out.value = row[1] + (row[2] - row[1]) * fx;
  const float left = row[2] - row[0], right = row[3] - row[1];
  out.dx = 0.5F * (left + (right - left) * fx);
  for (int k = 0; k < 2; ++k)
    down[k] = static_cast<float>(r2[k] - r0[k]) * (1 - fy) + static_cast<float>(r3[k] - r1[k]) * fy;
  out.dy = 0.5F * (down[0] + (down[1] - down[0]) * fx);
  return true;
}

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
