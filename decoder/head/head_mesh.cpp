#include "decoder/head/head_mesh.h"

namespace fbs {
namespace {

HeadMesh make_head_mesh() {
  const GenericHead& head = generic_head();
  HeadMesh mesh;
  mesh.triangles.assign(head.triangles.begin(), head.triangles.end());
  const std::size_t n = head.outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    const std::uint16_t a = head.outline[i], b = head.outline[j];
    const auto ring_a = static_cast<std::uint16_t>(kVertexCount + i);
    const auto ring_b = static_cast<std::uint16_t>(kVertexCount + j);
    mesh.triangles.push_back({a, ring_a, ring_b});
    mesh.triangles.push_back({a, ring_b, b});
  }
  mesh.vertex_count = kVertexCount + n;
  return mesh;
}

}  // namespace

const HeadMesh& head_mesh() {
  static const HeadMesh mesh = make_head_mesh();
  return mesh;
}

}  // namespace fbs
