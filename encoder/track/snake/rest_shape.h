// The rest position of a feature's snake on the adapted head, and which of its points repel each other.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "bitstream/syntax.h"
#include "encoder/track/snake/b_snake.h"
#include "encoder/track/snake/feature_patch.h"

namespace fbs {

/// The curve that tracks a feature.
[[nodiscard]] SnakeCurve curve_of(FeatureId id);

/// A feature at rest on the adapted head, snake units of the head frame.
struct RestShape {
  std::vector<glm::dvec2> control;  ///< including pinned ones
  PatchPlane plane;                 ///< the snake's patch, and the feature's depth
  double below_vertices = 0;        ///< distance of the curve below the vertices it moves
  double lowest = 1e9;              ///< y that a lid's middle does not pass: just above the lower lid
};
[[nodiscard]] RestShape rest_shape(FeatureId id, const SnakeCurve& curve, const Geometry& geometry);

/// Upper and lower lip, or the two ends of a brow; none for lids.
/// @param rest  control points
[[nodiscard]] std::vector<FacingPair> facing_pairs(FeatureId id, const SnakeCurve& curve,
                                                   const std::vector<glm::dvec2>& rest);

}  // namespace fbs
