#include "decoder/head/head_mesh.h"

#include "common/generic_head.h"

namespace fbs {

HeadMesh::HeadMesh(const WireFrame& head)
    : triangles(head.triangles.begin(), head.triangles.end()), head_count(head.vertices.size()) {
  const std::size_t n = head.outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    const std::uint16_t a = head.outline[i], b = head.outline[j];
    const auto ring_a = static_cast<std::uint16_t>(head_count + i);
    const auto ring_b = static_cast<std::uint16_t>(head_count + j);
    triangles.push_back({a, ring_a, ring_b});
    triangles.push_back({a, ring_b, b});
  }
  vertex_count = head_count + n;
}

const HeadMesh& generic_head_mesh() {
  static const HeadMesh mesh(generic_head());
  return mesh;
}

}  // namespace fbs
