// Distances along the edges of the generic head's mesh.
#pragma once

#include <vector>

namespace fbs {

/// Shortest path along the mesh's edges between each pair of vertices, in eye distances, on the generic head.
/// Method: Floyd-Warshall. [a * kVertexCount + b]
[[nodiscard]] const std::vector<float>& edge_distances();

}  // namespace fbs
