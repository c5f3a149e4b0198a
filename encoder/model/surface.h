// Points fixed on the surface of the head.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "encoder/model/pose.h"
#include "encoder/model/skinning.h"

namespace fbs {

/// A point fixed on a triangle of the mesh.
struct SurfacePoint {
  std::uint16_t triangle;
  HeadTriangle corner;
  std::array<float, 3> barycentric;

  [[nodiscard]] glm::dvec3 on(const HeadVertices& v) const {
    return static_cast<double>(barycentric[0]) * v[corner[0]] +
           static_cast<double>(barycentric[1]) * v[corner[1]] +
           static_cast<double>(barycentric[2]) * v[corner[2]];
  }
};

/// Points spread evenly over the mesh as projected by `projection`.
/// @param spacing_px  between neighbours, pixels of the picture
/// @param mouth_rows  least number of points across each triangle of the mouth interior, which has no area
///                    while the lips are closed
[[nodiscard]] std::vector<SurfacePoint> spread_over_mesh(const HeadVertices& vertices,
                                                         const PoseProjection& projection, double spacing_px,
                                                         int mouth_rows = 1);

}  // namespace fbs
