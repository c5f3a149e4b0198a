// The two sides of drawing: where the mesh lies on the screen, and where a pattern holds what it shows.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/state.h"
#include "decoder/head/face_light.h"

namespace fbs {

/// Everything of a scene on the screen in the state to be drawn.
struct ScreenMesh {
  std::vector<glm::ivec3> head;  ///< HeadMesh::vertex_count; x, y: 1/64 pixel, z: head units, depth
  /// Points of SceneGeometry::surround_triangles(), 1/64 pixel: the grid's, Surround::project(), and the
  /// head's if it is a plane.
  std::vector<glm::ivec2> surround;
  /// Of each vertex of the head, how much of the face is seen round it: the area of the face's triangles at
  /// the vertex that face the viewer, twice, 1/64 pixel squared. SPEC 11.5.
  std::vector<std::int64_t> areas;
  std::vector<VertexLight> light;                       ///< of each vertex of the head; empty: none has any
  std::int32_t mouth_gap = 0;                           ///< between the middles of the inner lips, head units
  std::array<std::int32_t, kInteriorCount> interior{};  ///< State::interior
};

/// The same mesh in a pattern, which was seen in a state of its own. Positions are 1/64 pixel of the pattern.
struct TextureMesh {
  std::vector<glm::ivec2> head;      ///< HeadMesh::vertex_count
  std::vector<glm::ivec2> surround;  ///< as ScreenMesh::surround
  std::vector<VertexLight> light;    ///< that the pattern already has; empty: none
  std::int32_t mouth_gap = 0;        ///< head units
  std::vector<std::int64_t> areas;   ///< ScreenMesh::areas, of what the pattern shows
};

}  // namespace fbs
