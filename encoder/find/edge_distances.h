// Distances along the edges of a wire-frame.
#pragma once

#include <vector>

#include "common/wire_frame.h"

namespace fbs {

/// Shortest path along the edges between each pair of the frame's n vertices, in eye distances; infinite
/// where there is none. Method: Floyd-Warshall. [a * n + b]
[[nodiscard]] std::vector<float> edge_distances(const WireFrame& frame);

}  // namespace fbs
