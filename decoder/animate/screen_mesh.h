// The two sides of drawing: the mesh on the screen, and the same mesh in a pattern.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/state.h"
#include "decoder/head/face_light.h"

namespace fbs {

/// The mesh of a scene on the screen, in the state to be drawn.
struct ScreenMesh {
  std::vector<glm::ivec3> head;  ///< HeadMesh::vertex_count; x, y: 1/64 pixel, z: head units, depth
  /// Points of SceneGeometry::surround_triangles(), 1/64 pixel: the grid's, Surround::project(), and the
  /// head's if it is a plane.
  std::vector<glm::ivec2> surround;
  /// For each vertex of the head, how much of the face is seen around it: twice the area of those face
  /// triangles at the vertex that face the viewer, 1/64 pixel squared. SPEC 11.5.
  std::vector<std::int64_t> areas;
  std::vector<VertexLight> light;                       ///< at each vertex of the head; empty: no light
  std::int32_t mouth_gap = 0;                           ///< between the middles of the inner lips, head units
  std::array<std::int32_t, kInteriorCount> interior{};  ///< State::interior
};

/// The same mesh in a pattern, which was seen in a state of its own. Positions are 1/64 pixel of the pattern.
struct TextureMesh {
  std::vector<glm::ivec2> head;      ///< HeadMesh::vertex_count
  std::vector<glm::ivec2> surround;  ///< as ScreenMesh::surround
  std::vector<VertexLight> light;    ///< already in the pattern; empty: none
  std::int32_t mouth_gap = 0;        ///< head units
  std::vector<std::int64_t> areas;   ///< ScreenMesh::areas in the pattern
};

}  // namespace fbs
