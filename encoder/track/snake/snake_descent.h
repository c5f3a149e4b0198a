// Sign descent: how a snake comes to rest on a picture.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "encoder/track/snake/b_snake.h"

namespace fbs {

struct SnakeOutcome {
  std::vector<glm::dvec2> control;  ///< at the least energy met
  int iterations = 0;               ///< in all descents
  int restarts = 0;
  double energy = 0;
};

/// Takes the signs of dE/dX_i and dE/dY_i of all control points, then moves them all by delta_q against the
/// sign; delta_q = delta_0 sigma^q with delta_0 = 1 snake unit and sigma = 0.75. Stops when the energy
/// changes by less than a threshold from one iteration to the next, at 15 iterations at the latest. A descent
/// still moving when its steps have become small restarts from where it is (the steps sum to 4 units at
/// most).
[[nodiscard]] SnakeOutcome descend(const BSnake& snake, std::vector<glm::dvec2> start);

}  // namespace fbs
