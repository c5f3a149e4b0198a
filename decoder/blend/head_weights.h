// How the head is blended: warped sources in the atlas, and the result with still sources on the screen.
// SPEC 11.5. Integers only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "decoder/blend/mesh_blend.h"

namespace fbs {

struct HeadWeights {
  std::vector<std::size_t> warped, still;  ///< numbers of the sources that show at some vertex
  PointWeights atlas;   ///< of `warped`, at the vertices of the HeadMesh; each row sums to kMeshWeightOne
  PointWeights screen;  ///< of the atlas, then of `still`
};

/// @param head  the wire-frame
[[nodiscard]] HeadWeights head_weights(const MeshBlend& blend, const WireFrame& head);

}  // namespace fbs
