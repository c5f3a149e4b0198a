// The definition of triangle_kernels.h, one sample after another.
#pragma once

#include <algorithm>

#include "decoder/raster/triangle_kernels.h"

namespace fbs::plain {

void draw_triangles(const TriangleList& list, const Shading& shading, DepthPlane& depth);

/// Calls show(row, RowRun) for the samples of a triangle that are nearer than the depth recorded, which is
/// updated.
/// @param rows  only these
template <class Show>
void cover(const DrawnTriangle& t, int first_row, int end_row, DepthPlane& depth, Show&& show) {
  for (int y = std::max(first_row, t.box.y0); y < std::min(end_row, t.box.y1); ++y)
    if (const RowRun run = covered_run(t.edges, y, t.box); !run.empty())
      for_each_nearer(depth.row(y), run, {t.depth.at(run.first, y), t.depth.dx},
                      [&](RowRun nearer) { show(y, nearer); });
}

[[nodiscard]] int count_covered(const DepthPlane& depth, const SampleArea& part);

}  // namespace fbs::plain
