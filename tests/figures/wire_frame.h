// Hidden lines of the wire-frame removed. Paper section 2.1.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/state.h"
#include "common/wire_frame.h"

namespace fbs {

using LineSegment = std::array<glm::dvec2, 2>;

/// The parts of a wire-frame's edges that no triangle hides. An edge is drawn where one of its triangles
/// faces the viewer.
/// @param vertices  the frame's; x and y in the picture, y down, z away from the viewer, all in one unit
[[nodiscard]] std::vector<LineSegment> visible_edges(const WireFrame& frame,
                                                     std::span<const glm::dvec3> vertices);

/// The vertices at which such an edge begins or ends.
[[nodiscard]] std::vector<glm::dvec2> visible_vertices(const WireFrame& frame,
                                                       std::span<const glm::dvec3> vertices);

/// Vertices of a head as the decoder projects them, all in pixels.
/// @param vertices  SceneGeometry::project_vertices() of `state`
[[nodiscard]] std::vector<glm::dvec3> screen_vertices(std::span<const glm::ivec3> vertices,
                                                      const State& state);

}  // namespace fbs
