// The triangles of the head and of the ring round it. SPEC 8.7.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/generic_head.h"

namespace fbs {

/// Corners of a triangle of any mesh, clockwise; indices of points.
using MeshTriangle = std::array<std::int32_t, 3>;

/// The 105 vertices and the ring round them: one vertex per outline vertex, farther out, that moves with the
/// surround under it. Between the two the jaw can move against the neck without tearing the picture.
struct HeadMesh {
  std::vector<HeadTriangle> triangles;  ///< clockwise in the picture seen from the front
  std::size_t vertex_count = 0;         ///< kVertexCount + ring
};

[[nodiscard]] const HeadMesh& head_mesh();

}  // namespace fbs
