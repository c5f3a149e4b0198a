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

SampleArea StateChoice::region_of(const Scene& scene, const State& a, const State& b) {
  glm::ivec2 low(kMaxScreen), high(-kMaxScreen);
  for (const State* s : {&a, &b}) {
    for (const glm::ivec3& p : scene.geometry->project_vertices(*s)) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  constexpr int kMargin = 4;  // pixels
  const int w = scene.setup.format.width, h = scene.setup.format.height;
  const auto pixel = [](int screen) { return screen >> kScreenOneLog2; };
  return {std::clamp(pixel(low.x) - kMargin, 0, w), std::clamp(pixel(low.y) - kMargin, 0, h),
          std::clamp(pixel(high.x) + kMargin, 0, w), std::clamp(pixel(high.y) + kMargin, 0, h)};
}

double StateChoice::cost(const Scene& scene, const Picture& source, const State& state, const SampleArea& region,
                         const MotionCounter& counter) {
  if (drawn_.width != source.width() || drawn_.height != source.height()) drawn_ = Plane(source.width(), source.height());
  renderer_.render_head_luma(scene, state, region, drawn_);
  std::int64_t squares = 0;
  for (int y = region.y0; y < region.y1; ++y) {
    const std::uint8_t *a = source.y.row(y), *b = drawn_.row(y);
    for (int x = region.x0; x < region.x1; ++x) {
      const int d = a[x] - b[x];
      squares += d * d;
    }
  }
  return static_cast<double>(squares) + lambda_ * counter.cost(state) / 256;
}

State StateChoice::choose(const Scene& scene, const Picture& source, const State& before, const State& tracked,
                          const MotionCounter& counter) {
  if (before == tracked) return before;
  const SampleArea region = region_of(scene, before, tracked);
  const auto judge = [&](const State& s) { return cost(scene, source, s, region, counter); };
  State best = tracked;
  double best_cost = judge(tracked);
  if (const double held = judge(before); held < best_cost) {
    best = before;
    best_cost = held;
  }
  for (int part = 0; part <= kFeatureCount; ++part) {
    State other = best;
    take_part(other, tracked, part);
    if (other == best) take_part(other, before, part);
    if (other == best) continue;
    if (const double c = judge(other); c < best_cost) {
      best = other;
      best_cost = c;
    }
  }
  return best;
}

}  // namespace fbs
