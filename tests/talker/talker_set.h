// Everything around the head: a static wall with a shelf and a plant, and a clothed body with its neck.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "tests/talker/talker_paint.h"

namespace fbs::talker {

/// Linear colour of the wall; place in picture heights, x from the middle, y from the top.
[[nodiscard]] glm::vec3 background(glm::vec2 place, const Look& look, float pixels_per_height);

/// Position of the body in a frame; body frame: eye distances of frame 0, origin at the head's origin at
/// rest.
struct BodyState {
  glm::vec2 neck_top;  ///< where the neck meets the head
  glm::vec2 chin;      ///< lowest point of the chin: below it is shadow
  float pixels_per_unit;
};

/// The material at `place` of the body, or nothing; the normal is in screen directions.
[[nodiscard]] std::optional<Material> body(glm::vec2 place, const BodyState& state, const Look& look);

}  // namespace fbs::talker
