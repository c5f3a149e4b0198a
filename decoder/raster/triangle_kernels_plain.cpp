#include "decoder/raster/triangle_kernels_plain.h"

#include "decoder/raster/texture_sampler.h"

namespace fbs::plain {
namespace {

/// A quantity along a row of the triangle's box.
LinearRow along(const ShortGradient& g, int row) {
  return {g.first + std::int64_t{g.dy} * row, g.dx};
}

}  // namespace

void draw_short_triangle(const ShortTriangle& t, PlaneScale scale, std::span<const ConstPlaneView> textures,
                         std::span<const PlaneView> target, DepthPlane& depth) {
  RunWalker runs = t.runs;
  for (int row = t.box.y0; row < t.box.y1; ++row) {
    const RowRun run = runs.next();
    for (int column = run.first; column <= run.last; ++column) {
      const int x = column - t.box.x0, y = row - t.box.y0;
      const auto here = static_cast<std::int32_t>(along(t.depth, y).at(x));
      if (here >= depth.row(row)[column]) continue;
      depth.row(row)[column] = here;
      const TextureRow place{along(t.u, y).from(x), along(t.v, y).from(x)};
      for (std::size_t k = 0; k < plane_count(scale); ++k) {
        std::uint8_t* const out = target[k].row(row) + column;
        sample_row(textures[k], place, out, 1);
        if (t.has_light && scale == PlaneScale::kLuma)
          light_row(out, along(t.offset, y).from(x), along(t.gain, y).from(x), 1);
      }
    }
  }
}

}  // namespace fbs::plain
