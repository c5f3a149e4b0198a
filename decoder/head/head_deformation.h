// How control points deform the head. Paper section 2.1; SPEC 8.5 and 8.6. Integers only.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "common/generic_head.h"
#include "common/state.h"

namespace fbs {

/// Vertices of the head in the head frame once the control points have displaced them, head units. The pupils
/// stay between the lids.
/// @param neutral  the adapted head (Geometry::positions)
[[nodiscard]] std::array<glm::ivec3, kVertexCount> deform(const std::array<glm::ivec3, kVertexCount>& neutral,
                                                          const State& state);

/// The same on the screen: as HeadProjection gives.
[[nodiscard]] std::array<glm::ivec3, kVertexCount> project_vertices(
    const std::array<glm::ivec3, kVertexCount>& neutral, const State& state);

}  // namespace fbs
