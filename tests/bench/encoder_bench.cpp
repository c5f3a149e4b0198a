#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "encoder/adapt.h"
#include "encoder/b_snake.h"
#include "encoder/head_tracker.h"
#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

void SnakeMinimise(benchmark::State& state) {
  constexpr int kSize = 120;
  SnakeImage image;
  image.contrast_x = image.contrast_y = image.change = cv::Mat1f::zeros(kSize, kSize);
  image.origin = {-40, -40};
  image.px_per_unit = 1.5;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const glm::dvec2 p = glm::dvec2(x, y) / 1.5 - 40.0;
      const double r = std::hypot(p.x, p.y), slope = -0.25 / std::pow(std::cosh((r - 12) / 2), 2);
      image.contrast_x(y, x) = static_cast<float>(slope * p.x / (r + 1e-9));
      image.contrast_y(y, x) = static_cast<float>(slope * p.y / (r + 1e-9));
    }
  }
  const SnakeCurve curve = SnakeCurve::closed(10, 40);
  const SnakeWeights weights{
      .tension = 0.0012, .rigidity = 0.002, .temporal = 0.004, .shape = 0.012, .contrast = 1, .change = 0.05};
  std::vector<glm::dvec2> start;
  for (int i = 0; i < 10; ++i) {
    const double a = 2 * std::numbers::pi * i / 10;
    start.emplace_back(13.5 * std::cos(a), 13.5 * std::sin(a));
  }
  const std::vector<FacingPair> facing;
  const BSnake snake(curve, image, weights, start, start, facing);
  int iterations = 0;
  for (auto _ : state) iterations += snake.minimise(start).iterations;
  state.counters["iterations"] = static_cast<double>(iterations) / static_cast<double>(state.iterations());
}
BENCHMARK(SnakeMinimise)->Unit(benchmark::kMicrosecond);

void HeadTrack(benchmark::State& state) {
  TalkerClip clip(talker_settings(352, 288, 8));
  const AdaptedHead head = *adapt_head(clip.marks(0));
  const double eye = head.pose.eye_distance_px();
  std::array<glm::dvec3, kVertexCount> neutral;
  for (std::size_t v = 0; v < kVertexCount; ++v) neutral[v] = glm::dvec3(head.geometry.positions[v]);
  std::vector<WorkFrame> frames;
  for (int i = 0; i < clip.count(); ++i)
    frames.push_back(WorkFrame::cut(clip[i], head.pose.shift, eye, false));
  HeadTracker tracker(head.geometry, head.pose, frames[0]);
  int i = 0, step = 1;
  for (auto _ : state) {  // to and fro, so that each picture follows its neighbour
    if (i + step < 0 || i + step >= clip.count()) step = -step;
    i += step;
    benchmark::DoNotOptimize(tracker.track(frames[static_cast<std::size_t>(i)], neutral));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(HeadTrack)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace fbs
