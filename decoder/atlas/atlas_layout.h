// The head laid out flat, so that no triangle hides another and all have room, even closed lips and lids:
// here the textures of all patterns can be blended. SPEC 10.12. Integers only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "common/wire_frame.h"
#include "decoder/field/node_cover.h"
#include "decoder/field/node_grid.h"

namespace fbs {

/// The atlas at one size.
struct AtlasLayout {
  int width, height;  ///< luma samples; whole blocks
  /// Positions of the vertices of the HeadMesh, then of the skirt: one more for each of the ring, beyond it,
  /// so that the ring's texture can be read up to its edge. 1/64 luma sample.
  std::vector<glm::ivec2> points;
  /// Corners of the triangles: the HeadMesh's, then the skirt's. Clockwise.
  std::vector<MeshTriangle> triangles;
  NodeCover cover;                     ///< all nodes; those outside are placed at the nearest point
  std::vector<glm::ivec2> blocks;      ///< column and row of the blocks that show some of the head
  std::size_t head_count;              ///< vertices of the wire-frame
  std::vector<std::uint16_t> outline;  ///< of the wire-frame

  /// @param eye_distance  samples
  AtlasLayout(const WireFrame& head, int eye_distance);

  /// Appends the points of the skirt to the vertices of the HeadMesh, in the atlas or in a pattern.
  void add_skirt(std::vector<glm::ivec2>& at) const;
};

/// Eye distance of the atlas for a head of this size, samples.
/// @param scale  samples of the picture per eye distance in the rest state, Q16
[[nodiscard]] int atlas_eye_distance(std::int64_t scale);

/// The generic head's layout, valid for the program's lifetime.
/// @param scale  as above
[[nodiscard]] const AtlasLayout& generic_atlas_layout(std::int64_t scale);

/// The skirt's point beyond a point of the ring.
/// @param outline, ring  a vertex of the outline and its vertex of the ring
[[nodiscard]] glm::ivec2 skirt_point(glm::ivec2 outline, glm::ivec2 ring);

}  // namespace fbs
