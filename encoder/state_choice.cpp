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

}  // namespace

State choose_state(std::span<const State> candidates, const PictureFit& fit, const MotionCounter& counter,
                   double lambda) {
  const auto judge = [&](const State& s) { return fit.distortion(s) + lambda * counter.cost(s) / 256; };
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
