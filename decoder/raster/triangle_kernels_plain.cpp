#include "decoder/raster/triangle_kernels_plain.h"

#include <algorithm>

#include "decoder/raster/blend_weights.h"
#include "decoder/raster/finish.h"
#include "decoder/raster/texture_sampler.h"

namespace fbs::plain {
namespace {

/// A quantity along a row of the triangle's box.
LinearRow along(const ShortGradient& g, int row) {
  return {g.first + std::int64_t{g.dy} * row, g.dx};
}

/// A sample of each source in one plane.
struct Sample {
  const ShortTriangle& t;
  std::span<const TextureSource> sources;
  std::size_t plane;
  int column, row;

  [[nodiscard]] std::uint8_t of_texture(bool has_light) const {
    const int x = column - t.box.x0, y = row - t.box.y0;
    std::uint8_t out = 0;
    sample_row(sources[0].planes[plane], {along(t.u, y).from(x), along(t.v, y).from(x)}, &out, 1);
    if (has_light) light_row(&out, along(t.offset, y).from(x), along(t.gain, y).from(x), 1);
    return out;
  }
  [[nodiscard]] std::uint8_t blended(bool has_light) const {
    std::int64_t left = kWeightOne, sum = kWeightOne / 2;
    for (std::size_t k = 0; k < sources.size(); ++k) {
      const int sample = k == 0 ? of_texture(has_light) : sources[k].planes[plane].row(row)[column];
      const std::int64_t weight =
          k + 1 == sources.size()
              ? left
              : std::clamp<std::int64_t>(
                    along(t.weight[k], row - t.box.y0).at(column - t.box.x0) >> kGradientOneLog2, 0, left);
      left -= weight;
      sum += weight * sample;
    }
    return static_cast<std::uint8_t>(sum >> kWeightOneLog2);
  }
};

}  // namespace

void draw_short_triangle(const ShortTriangle& t, PlaneScale scale, std::span<const TextureSource> sources,
                         std::span<const PlaneView> target, DepthPlane& depth) {
  RunWalker runs = t.runs;
  for (int row = t.box.y0; row < t.box.y1; ++row) {
    const RowRun run = runs.next();
    for (int column = run.first; column <= run.last; ++column) {
      const auto here = static_cast<std::int32_t>(along(t.depth, row - t.box.y0).at(column - t.box.x0));
      if (here >= depth.row(row)[column]) continue;
      depth.row(row)[column] = here;
      for (std::size_t k = 0; k < plane_count(scale); ++k)
        target[k].row(row)[column] =
            Sample{t, sources, k, column, row}.blended(t.has_light && scale == PlaneScale::kLuma);
    }
  }
}

int count_covered(const DepthPlane& depth, const SampleArea& part) {
  int out = 0;
  for (int y = part.y0; y < part.y1; ++y)
    for (int x = part.x0; x < part.x1; ++x) out += is_covered(depth.row(y)[x]) ? 1 : 0;
  return out;
}

}  // namespace fbs::plain
