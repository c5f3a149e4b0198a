#include "decoder/raster/rasteriser.h"

#include <algorithm>

#include "decoder/raster/row_kernels.h"

namespace fbs {
namespace {

/// Texture positions are 1/64 luma pixel in all planes, gradients 2^-16 sample.
constexpr std::int64_t kHalfSample = 1 << 15;

constexpr int kDepthBits = 16;  // depth keeps its unit

/// Whether every sample that the triangle can ask for lies a whole sample inside the texture.
bool reads_inside(const TextureSource& source, int position_bits) {
  const ConstPlaneView& texture = source.planes.front();
  const int margin = 2 << position_bits;
  const int max_x = (texture.width << position_bits) - margin,
            max_y = (texture.height << position_bits) - margin;
  return std::all_of(source.corners.begin(), source.corners.end(), [&](glm::ivec2 p) {
    return p.x >= margin && p.x <= max_x && p.y >= margin && p.y <= max_y;
  });
}

/// Fills runs of one triangle: everything that is linear over it but depth.
class RunPainter {
 public:
  RunPainter(const TriangleSetup& setup, const TextureSource& source, const RasterTarget& target,
             const Finish& finish)
      : setup_(setup), source_(source), target_(target), finish_(finish) {
    const auto& c = source.corners;
    u_ = setup.gradient({c[0].x, c[1].x, c[2].x}, setup.position_bits());
    v_ = setup.gradient({c[0].y, c[1].y, c[2].y}, setup.position_bits());
    inside_ = u_.exact() && v_.exact() && reads_inside(source, setup.position_bits());
    if (finish.light != nullptr) {
      offset_ = setup.gradient(finish.light->offset, 0);
      gain_ = setup.gradient(finish.light->gain, 0);
    }
    if (finish.interior != nullptr) ramp_ = setup.gradient(finish.interior->ramp, 0);
  }

  void paint(int row, RowRun run) const {
    const FromCorner at = setup_.from_corner(run.first, row);
    const int bits = setup_.position_bits();
    const auto along = [&](const Gradient& g) { return LinearRow{g.at(at, bits), g.dx}; };
    TextureRow texture{along(u_), along(v_)};
    texture.u.first -= kHalfSample;
    texture.v.first -= kHalfSample;
    for (std::size_t i = 0; i < target_.planes.size(); ++i) {
      std::uint8_t* out = target_.planes[i].row(row) + run.first;
      if (inside_)
        sample_row_inside(source_.planes[i], texture, out, run.count());
      else
        sample_row_clamped(source_.planes[i], texture, out, run.count());
      if (finish_.light != nullptr && i == 0) light_row(out, along(offset_), along(gain_), run.count());
      if (const InteriorMix* mix = finish_.interior)
        mix_interior_row(out, mix->colours[i], mix->opacity, along(ramp_), run.count());
    }
  }

 private:
  const TriangleSetup& setup_;
  const TextureSource& source_;
  const RasterTarget& target_;
  const Finish& finish_;
  Gradient u_, v_, offset_, gain_, ramp_;
  bool inside_;
};

}  // namespace

void draw_triangle(const ScreenTriangle& t, const TextureSource& source, const RasterTarget& target,
                   const Finish& finish) {
  const TriangleSetup setup(t, target.scale);
  const int first_row = std::max(target.area.y0, setup.first_row()),
            last_row = std::min(target.area.y1 - 1, setup.last_row());
  if (!setup.faces_viewer() || first_row > last_row) return;
  const RunPainter painter(setup, source, target, finish);
  Gradient z;
  if (target.depth != nullptr) z = setup.gradient({t[0].depth, t[1].depth, t[2].depth}, kDepthBits);
  for (int row = first_row; row <= last_row; ++row) {
    const RowRun run = covered_run(setup, row, target.area);
    if (run.empty()) continue;
    if (target.depth == nullptr)
      painter.paint(row, run);
    else
      for_each_nearer(target.depth->row(row), run,
                      {z.at(setup.from_corner(run.first, row), setup.position_bits()), z.dx},
                      [&](RowRun nearer) { painter.paint(row, nearer); });
  }
}

}  // namespace fbs
