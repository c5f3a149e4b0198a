#include "encoder/state_choice.h"

#include <algorithm>

namespace fbs {
namespace {

/// Takes one part of a state from another: 0 the pose, 1 + i FeatureId i.
void take_part(State& state, const State& from, int part) {
  if (part == 0) {
    state.pose = from.pose;
    return;
  }
  const Feature& f = generic_head().features[static_cast<std::size_t>(part - 1)];
  const auto first = from.control.begin() + f.first_control;
  std::copy(first, first + f.control_count, state.control.begin() + f.first_control);
}

/// What a viewer sees of lips and lids that are not where they should be, beyond what squared differences
/// say: in bits that would be well spent to have them right.
double wrong_expression(const State& state, const State& wanted, double units_per_step) {
  constexpr double kTolerance = 0.03 * kUnitsPerEyeDistance;
  double sum = 0;
  for (std::size_t c = 0; c < kControlCount; ++c) {
    const glm::dvec2 d = glm::dvec2(state.control[c] - wanted.control[c]) * units_per_step;
    sum += d.x * d.x + d.y * d.y;
  }
  return sum / (kTolerance * kTolerance);
}

}  // namespace

State choose_state(std::span<const State> candidates, const PictureFit& fit, const MotionCounter& counter,
                   double lambda) {
  const State& wanted = candidates.back();
  const auto judge = [&](const State& s) {
    return fit.distortion(s) +
           lambda * (counter.cost(s) / 256 + wrong_expression(s, wanted, fit.steps().control));
  };
  State best = candidates.front();
  double best_cost = judge(best);
  for (const State& candidate : candidates.subspan(1)) {
    if (candidate == best) continue;
    if (const double c = judge(candidate); c < best_cost) {
      best = candidate;
      best_cost = c;
    }
  }
  for (int part = 0; part <= kFeatureCount; ++part) {
    for (const State& candidate : candidates) {
      State other = best;
      take_part(other, candidate, part);
      if (other == best) continue;
      if (const double c = judge(other); c < best_cost) {
        best = other;
        best_cost = c;
      }
    }
  }
  return best;
}

}  // namespace fbs
