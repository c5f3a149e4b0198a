// The samples of a row that are drawn: covered by a triangle, and nearer than the samples already there. SPEC
// 10.6 and 10.9. Integers only.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "decoder/raster/triangle_setup.h"

namespace fbs {

/// Samples first..last of a row; none when last < first.
struct RowRun {
  int first, last;
  [[nodiscard]] bool empty() const { return first > last; }
  [[nodiscard]] int count() const { return last - first + 1; }
};

/// Quotient rounded down; b > 0.
[[nodiscard]] inline std::int64_t floor_div(std::int64_t a, std::int64_t b) {
  return a >= 0 ? a / b : -((-a + b - 1) / b);
}

/// The samples of a row within `area` whose centre the triangle covers (top-left rule).
/// @param edges  of a triangle that faces the viewer
[[nodiscard]] inline RowRun covered_run(const std::array<Edge, 3>& edges, int row, const SampleArea& area) {
  std::int64_t first = area.x0, last = area.x1 - 1;
  for (const Edge& e : edges) {
    const std::int64_t at_zero = e.b * row + e.c;  // inside: a * column + at_zero >= 0
    if (e.a > 0)
      first = std::max(first, -floor_div(at_zero, e.a));
    else if (e.a < 0)
      last = std::min(last, floor_div(at_zero, -e.a));
    else if (at_zero < 0)
      last = first - 1;
  }
  if (first > last) return {0, -1};
  return {static_cast<int>(first), static_cast<int>(last)};
}

/// Depth of the samples drawn so far.
struct DepthPlane {
  static constexpr std::size_t kReadBeyond =
      8;  ///< vectors may read and write this many beyond the last sample

  int width = 0;
  SampleArea area;  ///< the rest is undefined
  std::vector<std::int32_t> depth;

  /// Makes everything in an area infinitely far.
  void reset(int w, int height, const SampleArea& within);
  [[nodiscard]] std::int32_t* row(int y) { return depth.data() + static_cast<std::ptrdiff_t>(y) * width; }
  [[nodiscard]] const std::int32_t* row(int y) const {
    return depth.data() + static_cast<std::ptrdiff_t>(y) * width;
  }
};

/// Depth of samples that nothing was drawn on.
inline constexpr std::int32_t kNothingDrawn = std::numeric_limits<std::int32_t>::max();
[[nodiscard]] constexpr bool is_covered(std::int32_t depth) {
  return depth != kNothingDrawn;
}

/// Depth along a run.
struct DepthRow {
  std::int64_t first;  ///< at the run's first sample
  std::int64_t step;   ///< per sample
};

inline constexpr std::int64_t kMinDepth = std::numeric_limits<std::int32_t>::min();
inline constexpr std::int64_t kMaxDepth = std::numeric_limits<std::int32_t>::max() - 1;

/// Calls draw(RowRun) for each run of samples nearer than the depth recorded, after recording theirs. Depths
/// are clamped to kMinDepth..kMaxDepth.
/// @param nearest  depth of the row's samples, from its first on
template <class Draw>
void for_each_nearer_clamped(std::int32_t* nearest, RowRun run, DepthRow z, Draw&& draw) {
  int begin = -1;
  for (int x = run.first; x <= run.last; ++x, z.first += z.step) {
    const auto here = static_cast<std::int32_t>(std::clamp(z.first, kMinDepth, kMaxDepth));
    if (here < nearest[x]) {
      nearest[x] = here;
      if (begin < 0) begin = x;
    } else if (begin >= 0) {
      draw(RowRun{begin, x - 1});
      begin = -1;
    }
  }
  if (begin >= 0) draw(RowRun{begin, run.last});
}

/// The same for a run whose depth stays within its limits.
template <class Draw>
void for_each_nearer_inside(std::int32_t* nearest, RowRun run, DepthRow z, Draw&& draw) {
  int x = run.first;
  std::int64_t depth = z.first;
  const auto nearer = [&] { return static_cast<std::int32_t>(depth) < nearest[x]; };
  while (x <= run.last) {
    for (; x <= run.last && !nearer(); ++x) depth += z.step;
    const int begin = x;
    for (; x <= run.last && nearer(); ++x, depth += z.step) nearest[x] = static_cast<std::int32_t>(depth);
    if (begin < x) draw(RowRun{begin, x - 1});
  }
}

/// Chooses between the two.
template <class Draw>
void for_each_nearer(std::int32_t* nearest, RowRun run, DepthRow z, Draw&& draw) {
  const auto within = [](std::int64_t depth) { return depth >= kMinDepth && depth <= kMaxDepth; };
  if (within(z.first) && within(z.first + z.step * (run.count() - 1)))
    for_each_nearer_inside(nearest, run, z, draw);
  else
    for_each_nearer_clamped(nearest, run, z, draw);
}

}  // namespace fbs
