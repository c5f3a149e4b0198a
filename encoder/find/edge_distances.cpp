#include "encoder/find/edge_distances.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fbs {
namespace {

/// Direct distances: lengths of edges, zero for a vertex to itself, infinite for all other pairs.
std::vector<float> edge_lengths(const WireFrame& frame) {
  const std::size_t n = frame.vertices.size();
  std::vector<float> d(n * n, std::numeric_limits<float>::infinity());
  for (std::size_t v = 0; v < n; ++v) d[v * n + v] = 0;
  for (const HeadTriangle& t : frame.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t a = t[i], b = t[(i + 1) % 3];
      const glm::dvec3 e = glm::dvec3(frame.vertices[a].position - frame.vertices[b].position) /
                           static_cast<double>(kUnitsPerEyeDistance);
      const auto length = static_cast<float>(std::sqrt(e.x * e.x + e.y * e.y + e.z * e.z));
      d[a * n + b] = d[b * n + a] = length;
    }
  }
  return d;
}

}  // namespace

std::vector<float> edge_distances(const WireFrame& frame) {
  const std::size_t n = frame.vertices.size();
  std::vector<float> d = edge_lengths(frame);
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) d[i * n + j] = std::min(d[i * n + j], d[i * n + k] + d[k * n + j]);
  return d;
}

}  // namespace fbs
