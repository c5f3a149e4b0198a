// The head laid out flat, so that no triangle hides another and all have room, also lips and lids that are
// closed: where textures of all patterns can be blended. SPEC 10.12. Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "decoder/field/node_cover.h"
#include "decoder/field/node_grid.h"

namespace fbs {

/// The vertices of head_mesh().
inline constexpr std::size_t kAtlasTableSize = 129;
/// Where they lie, 1/4096 eye distance. Made by author_head_atlas.py.
extern const std::array<glm::ivec2, kAtlasTableSize> kAtlasTable;

/// The atlas at one size.
struct AtlasLayout {
  int width, height;  ///< luma samples; whole blocks
  /// Where the vertices of head_mesh() lie, and then the skirt: one more for each of the ring, beyond it, so
  /// that what the ring shows can be read up to its edge. 1/64 luma sample.
  std::vector<glm::ivec2> points;
  /// Corners of the triangles: head_mesh(), then the skirt's. Clockwise.
  std::vector<MeshTriangle> triangles;
  NodeCover cover;                 ///< of all nodes; those outside have the place of the nearest point
  std::vector<glm::ivec2> blocks;  ///< column and row of those of which the head shows something

  explicit AtlasLayout(int eye_distance);
};

/// The atlas for a head of this size, which lives as long as the program.
/// @param scale  samples of the picture per eye distance in the rest state, Q16
[[nodiscard]] const AtlasLayout& atlas_layout(std::int64_t scale);

/// Adds the points of the skirt to those of the vertices of head_mesh(), in the atlas or in a pattern.
void add_skirt(std::vector<glm::ivec2>& points);

/// The point of the skirt beyond one of the ring.
/// @param outline, ring  the vertex of the outline and the one of the ring that belongs to it
[[nodiscard]] glm::ivec2 skirt_point(glm::ivec2 outline, glm::ivec2 ring);

}  // namespace fbs
