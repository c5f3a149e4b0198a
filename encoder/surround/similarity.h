// A similarity of the picture plane about the head's origin: the motion of body or ground.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>

#include "encoder/model/pose.h"

namespace fbs {

/// As State::body and State::ground, but in pixels.
using Similarity = std::array<double, kSimilarityCount>;

/// In the units of State::body and State::ground.
[[nodiscard]] inline std::int32_t to_state(double px) {
  return static_cast<std::int32_t>(std::lround(kStateUnitsPerPixel * px));
}

/// Displacement of a place, pixels of the picture.
/// @param from_head  the place relative to the head's origin in the first picture, eye distances
[[nodiscard]] inline glm::dvec2 displacement(const Similarity& s, glm::dvec2 from_head) {
  const glm::dvec2 d = from_head;
  return {s[kDisplacementX] + s[kSimilarityScale] * d.x - s[kSimilarityRotation] * d.y,
          s[kDisplacementY] + s[kSimilarityScale] * d.y + s[kSimilarityRotation] * d.x};
}

}  // namespace fbs
