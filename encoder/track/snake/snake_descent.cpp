#include "encoder/track/snake/snake_descent.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fbs {
namespace {

// The paper's schedule, snake units: the first step, and the ratio of each to the one before.
constexpr double kDelta0 = 1.0, kSigma = 0.75;
constexpr int kMaxIterations = 15;  // the paper's
constexpr int kMaxRestarts = 2;
constexpr double kStopChange = 2e-4;  // share of the energy, from iteration to iteration
constexpr double kNearlyFullReach =
    3.0;                        // snake units, of the 4 that the steps sum to: delta_0 / (1 - sigma)
constexpr double kFlat = 1e-7;  // energy per snake unit; a smaller slope is rounding

double against(double slope) {
  return slope > kFlat ? -1.0 : slope < -kFlat ? 1.0 : 0.0;
}

/// One descent from out.control; `best` keeps the least energy met.
void descend_once(const BSnake& snake, std::vector<glm::dvec2>& gradient, SnakeOutcome& out,
                  SnakeOutcome& best) {
  const SnakeCurve& curve = snake.curve();
  double delta = kDelta0;
  for (int q = 0; q < kMaxIterations; ++q, delta *= kSigma) {
    for (int i = curve.first_free(); i < curve.end_free(); ++i)
      out.control[i] += delta * glm::dvec2(against(gradient[i].x), against(gradient[i].y));
    const double now = snake.evaluate(out.control, &gradient) * curve.ds();
    const double change = now - out.energy;
    out.energy = now;
    ++out.iterations;
    if (now < best.energy) {
      best.control = out.control;
      best.energy = now;
    }
    if (std::abs(change) < kStopChange) break;
  }
}

double farthest_squared(const std::vector<glm::dvec2>& from, const std::vector<glm::dvec2>& to) {
  double farthest = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const glm::dvec2 d = to[i] - from[i];
    farthest = std::max(farthest, d.x * d.x + d.y * d.y);
  }
  return farthest;
}

}  // namespace

SnakeOutcome descend(const BSnake& snake, std::vector<glm::dvec2> start) {
  SnakeOutcome out{std::move(start), 0, 0, 0};
  SnakeOutcome best = out;
  std::vector<glm::dvec2> gradient, descent_start;
  for (int restart = 0; restart <= kMaxRestarts; ++restart) {
    descent_start = out.control;
    out.energy = snake.evaluate(out.control, &gradient) * snake.curve().ds();
    if (restart == 0) best.energy = out.energy;
    descend_once(snake, gradient, out, best);
    best.iterations = out.iterations;
    best.restarts = restart;
    // A control point that has moved nearly as far as all steps reach was still on its way.
    if (farthest_squared(descent_start, best.control) < kNearlyFullReach * kNearlyFullReach) break;
    out.control = best.control;
  }
  return best;
}

}  // namespace fbs
