// How control points deform the head. Paper section 2.1; SPEC 8.5 and 8.6. Integers only.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "bitstream/syntax.h"
#include "common/state.h"

namespace fbs {

/// Vertices of the head after displacement by the control points, head units. The pupils stay between the
/// lids.
[[nodiscard]] std::vector<glm::ivec3> deform(const Geometry& neutral, const State& state);

/// The same on the screen, by HeadProjection.
[[nodiscard]] std::vector<glm::ivec3> project_vertices(const Geometry& neutral, const State& state);

}  // namespace fbs
