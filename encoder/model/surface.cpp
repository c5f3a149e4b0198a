#include "encoder/model/surface.h"

#include <algorithm>
#include <cmath>

#include "decoder/head/mouth_interior.h"

namespace fbs {

std::vector<SurfacePoint> spread_over_mesh(const HeadVertices& vertices, const PoseProjection& projection,
                                           double spacing_px, int mouth_rows) {
  std::vector<SurfacePoint> out;
  const auto triangles = generic_head().triangles;
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    const HeadTriangle& t = triangles[k];
    const auto corner = [&](std::size_t i) { return projection(vertices[t[i]]); };
    const glm::dvec2 a = corner(0), e = corner(1) - a, f = corner(2) - a;
    const double area = std::abs(e.x * f.y - e.y * f.x) / 2;
    // n x n cells of the triangle, a point in the middle of each
    const int min_rows = is_mouth(generic_head(), t) ? mouth_rows : 1;
    const int n = std::max(min_rows, static_cast<int>(std::lround(std::sqrt(2 * area) / spacing_px)));
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        const auto s = static_cast<float>((i + 1.0 / 3) / n), q = static_cast<float>((j + 1.0 / 3) / n);
        out.push_back({static_cast<std::uint16_t>(k), t, {1 - s - q, s, q}});
      }
    }
  }
  return out;
}

}  // namespace fbs
