#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "encoder/track/snake/snake_descent.h"

namespace fbs {
namespace {

void SnakeMinimise(benchmark::State& state) {
  constexpr int kSize = 120;
  SnakeImage image;
  image.contrast_x = image.contrast_y = cv::Mat1f::zeros(kSize, kSize);
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
      .tension = 0.0012, .rigidity = 0.002, .temporal = 0.004, .shape = 0.012, .contrast = 1};
  std::vector<glm::dvec2> start;
  for (int i = 0; i < 10; ++i) {
    const double a = 2 * std::numbers::pi * i / 10;
    start.emplace_back(13.5 * std::cos(a), 13.5 * std::sin(a));
  }
  const std::vector<FacingPair> facing;
  const BSnake snake(curve, image, weights, start, start, facing);
  int iterations = 0;
  for (auto _ : state) iterations += descend(snake, start).iterations;
  state.counters["iterations"] = static_cast<double>(iterations) / static_cast<double>(state.iterations());
}
BENCHMARK(SnakeMinimise)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace fbs
