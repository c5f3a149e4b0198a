// The blend of a picture at the points of its mesh. SPEC 11.5. Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "decoder/animate/scene_geometry.h"
#include "decoder/blend/picture_blend.h"
#include "decoder/field/point_weights.h"

namespace fbs {

static_assert(kMeshWeightOne == kShareOne * kBlendOne);

/// Weights of the sources in each region, in 1/kBlendOne.
using RegionWeights = std::array<std::vector<std::int32_t>, kRegionCount>;

/// The sources of a picture and their weights.
struct MeshBlend {
  std::vector<BlendSource> sources;  ///< those used by any region; at most kRegionCount * kMaxRegionSources
  RegionWeights regions;
  PointWeights head;  ///< vertices of the HeadMesh; empty in a scene without a face
};

/// Leaves the weights of the head empty.
[[nodiscard]] MeshBlend blend_regions(const PictureBlend& blend);

/// Weights at points, from the points' shares of the regions.
[[nodiscard]] PointWeights point_weights(const RegionWeights& regions, std::span<const RegionShares> shares);

/// @param textures  one for each pattern: how much of the head it shows
/// @param mesh      the mesh to be drawn
[[nodiscard]] MeshBlend blend_mesh(const PictureBlend& blend, const SceneGeometry& geometry,
                                   std::span<const TextureMesh* const> textures, const ScreenMesh& mesh);

}  // namespace fbs
