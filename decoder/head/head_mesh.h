// The triangles of the head and of the ring round it. SPEC 8.7.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/wire_frame.h"

namespace fbs {

/// Corners of a triangle of any mesh, clockwise; indices of points.
using MeshTriangle = std::array<std::int32_t, 3>;

/// The vertices of a wire-frame and the ring round them: one vertex per outline vertex, farther out, that
/// moves with the surround under it. Between the two the jaw can move against the neck without tearing the
/// picture.
struct HeadMesh {
  std::vector<HeadTriangle> triangles;  ///< clockwise in the picture seen from the front
  std::size_t head_count = 0;           ///< vertices of the wire-frame; those of the ring follow
  std::size_t vertex_count = 0;         ///< of both

  explicit HeadMesh(const WireFrame& head);
};

/// Of the generic head.
[[nodiscard]] const HeadMesh& generic_head_mesh();

}  // namespace fbs
