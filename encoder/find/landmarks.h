// The landmarks' positions on the generic head.
#pragma once

#include <glm/vec3.hpp>

#include "common/generic_head.h"
#include "common/ibug.h"

namespace fbs {

/// Whether a landmark is a lid point or eye corner.
[[nodiscard]] constexpr bool is_eye_landmark(int landmark) {
  return landmark >= ibug::kEyesFirst && landmark < ibug::kEyesEnd;
}

/// Mean depth of the generic head's lids and eye corners in the head frame, eye distances.
[[nodiscard]] double generic_eye_depth();

/// A vertex of the generic head, eye distances; z counts from the eyes' depth backwards.
[[nodiscard]] glm::dvec3 generic_vertex(std::size_t vertex);

/// The same for a landmark.
[[nodiscard]] inline glm::dvec3 generic_landmark(int landmark) {
  return generic_vertex(vertex_of_landmark(landmark));
}

}  // namespace fbs
