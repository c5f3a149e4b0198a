// The triangles of the head and of the ring around it. SPEC 8.7.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/wire_frame.h"

namespace fbs {

/// Corners of a triangle of any mesh, clockwise; indices of points.
using MeshTriangle = std::array<std::int32_t, 3>;

/// An edge of the head's mesh: its vertices, rising.
using HeadEdge = std::array<std::uint16_t, 2>;

/// The vertices of a wire-frame and the ring around them: one vertex per outline vertex, farther out, that
/// moves with the surround under it. The band between lets the jaw move against the neck without tearing the
/// picture.
struct HeadMesh {
  std::vector<HeadTriangle> triangles;                       ///< clockwise in the picture seen from the front
  std::vector<HeadEdge> edges;                               ///< each once, rising
  std::vector<std::array<std::uint16_t, 3>> triangle_edges;  ///< of each triangle, indices of `edges`
  std::size_t head_count = 0;    ///< vertices of the wire-frame; the ring's follow
  std::size_t vertex_count = 0;  ///< with the ring's

  explicit HeadMesh(const WireFrame& head);
};

/// Width of the wire-frame without the ring.
/// @param vertices  its own, in any plane
[[nodiscard]] inline std::int32_t face_width(std::span<const glm::ivec3> vertices) {
  const auto [left, right] = std::minmax_element(
      vertices.begin(), vertices.end(), [](const glm::ivec3& a, const glm::ivec3& b) { return a.x < b.x; });
  return right->x - left->x;
}

/// The generic head's mesh.
[[nodiscard]] const HeadMesh& generic_head_mesh();

}  // namespace fbs
