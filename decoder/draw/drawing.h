// Everything that one picture is drawn from.
#pragma once

#include <algorithm>
#include <array>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "common/picture.h"
#include "decoder/animate/screen_mesh.h"
#include "decoder/atlas/head_atlas.h"
#include "decoder/blend/mesh_blend.h"
#include "decoder/field/padded_plane.h"
#include "decoder/head/mouth_interior.h"
#include "decoder/raster/triangle_setup.h"

namespace fbs {

/// A pattern, and the positions of the mesh in it.
struct DrawnSource {
  std::array<ConstPlaneView, 3> planes;   ///< Y, U, V
  const TextureMesh* texture = nullptr;   ///< null: the pattern is shown unwarped
  const PaddedPicture* padded = nullptr;  ///< if warped
  const HeadAtlas* atlas = nullptr;       ///< if warped, unless the scene's head is a plane
};

struct Drawing {
  const ScreenMesh& mesh;
  const MeshBlend& blend;
  std::vector<DrawnSource> sources;         ///< blend.sources
  std::array<InteriorColours, 3> interior;  ///< of each plane
  std::array<PlaneView, 3> target;          ///< Y, U, V
  SampleArea luma_area, chroma_area;        ///< parts of the target that are drawn; the rest is undefined

  [[nodiscard]] const SampleArea& area(PlaneScale scale) const {
    return scale == PlaneScale::kLuma ? luma_area : chroma_area;
  }
};

/// Samples within `limit` whose centres may lie in a box of positions, 1/64 luma pixel.
[[nodiscard]] inline SampleArea samples_in_box(glm::ivec2 low, glm::ivec2 high, PlaneScale scale,
                                               const SampleArea& limit) {
  const int bits = static_cast<int>(scale);
  return {std::clamp(low.x >> bits, limit.x0, limit.x1), std::clamp(low.y >> bits, limit.y0, limit.y1),
          std::clamp((high.x >> bits) + 1, limit.x0, limit.x1),
          std::clamp((high.y >> bits) + 1, limit.y0, limit.y1)};
}

/// The planes of Y, U, V that have the scale.
template <class T>
[[nodiscard]] std::span<const T> planes_of_scale(const std::array<T, 3>& planes, PlaneScale scale) {
  return scale == PlaneScale::kLuma ? std::span<const T>(planes).first(1)
                                    : std::span<const T>(planes).last(2);
}

}  // namespace fbs
