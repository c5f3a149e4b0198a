#include "encoder/find/edge_distances.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/generic_head.h"

namespace fbs {
namespace {

constexpr std::size_t kCount = kVertexCount;

/// Edges have their length, vertices none, and no other pair is joined.
std::vector<float> edge_lengths() {
  std::vector<float> d(kCount * kCount, std::numeric_limits<float>::infinity());
  for (std::size_t v = 0; v < kCount; ++v) d[v * kCount + v] = 0;
  const GenericHead& head = generic_head();
  for (const HeadTriangle& t : head.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t a = t[i], b = t[(i + 1) % 3];
      const glm::dvec3 e = glm::dvec3(head.vertices[a].position - head.vertices[b].position) /
                           static_cast<double>(kUnitsPerEyeDistance);
      const auto length = static_cast<float>(std::sqrt(e.x * e.x + e.y * e.y + e.z * e.z));
      d[a * kCount + b] = d[b * kCount + a] = length;
    }
  }
  return d;
}

}  // namespace

const std::vector<float>& edge_distances() {
  static const std::vector<float> table = [] {
    std::vector<float> d = edge_lengths();
    for (std::size_t k = 0; k < kCount; ++k)
      for (std::size_t i = 0; i < kCount; ++i)
        for (std::size_t j = 0; j < kCount; ++j)
          d[i * kCount + j] = std::min(d[i * kCount + j], d[i * kCount + k] + d[k * kCount + j]);
    return d;
  }();
  return table;
}

}  // namespace fbs
