// The blend of a picture brought to the points of its mesh. SPEC 11.5. Integers only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "decoder/animate/scene_geometry.h"
#include "decoder/blend/picture_blend.h"

namespace fbs {

inline constexpr int kMeshWeightOne = kShareOne * kBlendOne;

/// Weights of `sources` at points of the mesh, a row for each point; each row sums to kMeshWeightOne.
struct PointWeights {
  std::size_t sources = 0;
  std::vector<std::int32_t> weights;
  [[nodiscard]] std::span<const std::int32_t> at(std::size_t point) const {
    return std::span(weights).subspan(point * sources, sources);
  }
};

struct MeshBlend {
  std::vector<BlendSource> sources;  ///< all that some region uses; at most kRegionCount * kMaxRegionSources
  PointWeights head, surround;       ///< vertices of head_mesh(), grid points of the surround
  std::vector<std::int32_t> ground;  ///< weights where all is ground
};

/// @param textures  of each pattern: how much of the head it shows
/// @param mesh      to be drawn
[[nodiscard]] MeshBlend blend_mesh(const PictureBlend& blend, const SceneGeometry& geometry,
                                   std::span<const TextureMesh* const> textures, const ScreenMesh& mesh);

}  // namespace fbs
