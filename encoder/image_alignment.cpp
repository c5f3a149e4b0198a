#include "encoder/image_alignment.h"

#include <algorithm>
#include <cmath>

namespace fbs {

std::vector<SurfacePoint> spread_over_mesh(const HeadVertices& vertices, const PoseProjection& projection,
                                           double spacing_px, int mouth_rows) {
  std::vector<SurfacePoint> out;
  const auto triangles = generic_head().triangles;
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    const HeadTriangle& t = triangles[k];
    const auto corner = [&](std::size_t i) { return projection(vertices[static_cast<std::size_t>(t[i])]); };
    const glm::dvec2 a = corner(0), e = corner(1) - a, f = corner(2) - a;
    const double area = std::abs(e.x * f.y - e.y * f.x) / 2;
    // n x n cells of the triangle, a point in the middle of each
    const int least = std::all_of(t.begin(), t.end(), is_inner_lip) ? mouth_rows : 1;
    const int n = std::max(least, static_cast<int>(std::lround(std::sqrt(2 * area) / spacing_px)));
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        const auto s = static_cast<float>((i + 1.0 / 3) / n), q = static_cast<float>((j + 1.0 / 3) / n);
        out.push_back({static_cast<std::int16_t>(k), t, {1 - s - q, s, q}});
      }
    }
  }
  return out;
}

Pose moved(const Pose& p, const PoseStep& d) {
  Pose out = p;
  out.pitch += d[0];
  out.yaw += d[1];
  out.roll += d[2];
  out.shift += glm::dvec2(d[3], d[4]);
  out.log2_scale += d[5];
  constexpr double kMaxTurn = 1.2;  // beyond this the face is not seen any more
  out.pitch = std::clamp(out.pitch, -kMaxTurn, kMaxTurn);
  out.yaw = std::clamp(out.yaw, -kMaxTurn, kMaxTurn);
  out.roll = std::clamp(out.roll, -kMaxTurn, kMaxTurn);
  return out;
}

PoseJacobian::PoseJacobian(const Pose& pose) : projection_(pose) {
  constexpr double kStep = 1e-4;
  for (int k = 0; k < 3; ++k) {
    PoseStep d;
    d[k] = kStep;
    by_angle_[static_cast<std::size_t>(k)] =
        (PoseProjection(moved(pose, d)).matrix - projection_.matrix) / kStep;
  }
}

std::array<glm::dvec2, 6> PoseJacobian::at(glm::dvec3 p) const {
  return {glm::dvec2(by_angle_[0] * p),
          glm::dvec2(by_angle_[1] * p),
          glm::dvec2(by_angle_[2] * p),
          {1, 0},
          {0, 1},
          std::log(2.0) * glm::dvec2(projection_.matrix * p)};
}

}  // namespace fbs
