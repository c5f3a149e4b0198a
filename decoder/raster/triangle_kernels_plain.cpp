#include "decoder/raster/triangle_kernels_plain.h"

#include "decoder/raster/texture_sample.h"

namespace fbs::plain {
namespace {

/// A sample of a plane that shows a triangle.
struct Sample {
  std::span<const LinearPlane> quantities;
  const Shading& shading;
  std::size_t plane;
  int x, y;

  [[nodiscard]] std::int64_t at(std::size_t quantity) const { return quantities[quantity].at(x, y); }
  [[nodiscard]] int textured() const {
    if (shading.texture[plane].width == 0) return 0;
    const int sample = texture_sample(shading.texture[plane], at(0), at(1));
    if (shading.light == LightUse::kNone) return sample;
    return shading.light == LightUse::kAdded ? lit(sample, at(2), at(3)) : unlit(sample, at(2), at(3));
  }
  [[nodiscard]] std::uint8_t blended() const {
    const std::size_t first_weight = quantities.size() - shading.still_count();
    std::int64_t left = kWeightOne, sum = kWeightOne / 2;
    int sample = textured();
    for (std::size_t k = 0; k < shading.still_count(); ++k) {
      const auto weight = std::clamp<std::int64_t>(at(first_weight + k) >> kGradientOneLog2, 0, left);
      left -= weight;
      sum += weight * sample;
      sample = shading.still_plane(k, plane).row(y)[x];
    }
    return static_cast<std::uint8_t>((sum + left * sample) >> kWeightOneLog2);
  }
};

}  // namespace

void draw_triangles(const TriangleList& list, const Shading& shading, DepthPlane& depth) {
  for (const DrawnTriangle& t : list.triangles)
    cover(t, depth.area.y0, depth.area.y1, depth, [&](int y, RowRun run) {
      for (std::size_t p = 0; p < shading.target.size(); ++p)
        for (int x = run.first; x <= run.last; ++x)
          shading.target[p].row(y)[x] = Sample{list.quantities_of(t), shading, p, x, y}.blended();
    });
}

int count_covered(const DepthPlane& depth, const SampleArea& part) {
  int out = 0;
  for (int y = part.y0; y < part.y1; ++y)
    for (int x = part.x0; x < part.x1; ++x) out += is_covered(depth.row(y)[x]) ? 1 : 0;
  return out;
}

}  // namespace fbs::plain
