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

  const auto edge = [](const HeadTriangle& t, std::size_t k) {
    const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
    return HeadEdge{low, high};
  };
  for (const HeadTriangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) edges.push_back(edge(t, k));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const HeadTriangle& t : triangles) {
    std::array<std::uint16_t, 3>& of = triangle_edges.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      of[k] = static_cast<std::uint16_t>(std::lower_bound(edges.begin(), edges.end(), edge(t, k)) -
                                         edges.begin());
  }
}

const HeadMesh& generic_head_mesh() {
  static const HeadMesh mesh(generic_head());
  return mesh;
}

}  // namespace fbs
