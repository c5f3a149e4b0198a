#include "decoder/raster/row_runs.h"

namespace fbs {
namespace {

std::int64_t floor_div(std::int64_t a, std::int64_t b) {  // b > 0
  return a >= 0 ? a / b : -((-a + b - 1) / b);
}

/// An edge along a row: the sample at column x is inside where step * x + at >= 0.
struct EdgeInRow {
  std::int64_t at, step;
  EdgeInRow(const Edge& e, int row, int position_bits) {
    const std::int64_t half = std::int64_t{1} << (position_bits - 1);
    const std::int64_t y = (std::int64_t{row} << position_bits) + half;
    at = e.b * y + e.c + e.a * half;
    step = e.a * (std::int64_t{1} << position_bits);
  }
};

constexpr RowRun kNone{0, -1};

}  // namespace

RowRun covered_run(const TriangleSetup& triangle, int row, const SampleArea& area) {
  std::int64_t first = area.x0, last = area.x1 - 1;
  for (const Edge& edge : triangle.edges()) {
    const EdgeInRow e(edge, row, triangle.position_bits());
    if (e.step > 0) {
      first = std::max(first, -floor_div(e.at, e.step));
    } else if (e.step < 0) {
      last = std::min(last, floor_div(e.at, -e.step));
    } else if (e.at < 0) {
      return kNone;
    }
  }
  if (first > last) return kNone;
  return {static_cast<int>(first), static_cast<int>(last)};
}

void DepthPlane::reset(int w, int height, const SampleArea& area) {
  width = w;
  depth.resize(static_cast<std::size_t>(w) * static_cast<std::size_t>(height));
  for (int y = area.y0; y < area.y1; ++y)
    std::fill(row(y) + area.x0, row(y) + area.x1, std::numeric_limits<std::int32_t>::max());
}

}  // namespace fbs
