#include "decoder/raster/rasteriser.h"

#include <algorithm>
#include <cassert>
#include <optional>

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

/// The samples of one source along runs of one triangle: everything that is linear over it but depth.
class SourcePainter {
 public:
  SourcePainter(const TriangleSetup& setup, const TextureSource& source)
      : setup_(&setup), source_(&source), finish_(&source.finish) {
    const auto& c = source.corners;
    u_ = setup.gradient({c[0].x, c[1].x, c[2].x}, setup.position_bits());
    v_ = setup.gradient({c[0].y, c[1].y, c[2].y}, setup.position_bits());
    inside_ = u_.exact() && v_.exact() && reads_inside(source, setup.position_bits());
    if (finish_->light != nullptr) {
      offset_ = setup.gradient(finish_->light->offset, 0);
      gain_ = setup.gradient(finish_->light->gain, 0);
    }
    if (finish_->interior != nullptr) ramp_ = setup.gradient(finish_->interior->ramp, 0);
  }

  void paint(std::size_t plane, int row, RowRun run, std::uint8_t* out) const {
    const FromCorner at = setup_->from_corner(run.first, row);
    const int bits = setup_->position_bits();
    const auto along = [&](const Gradient& g) { return LinearRow{g.at(at, bits), g.dx}; };
    TextureRow texture{along(u_), along(v_)};
    texture.u.first -= kHalfSample;
    texture.v.first -= kHalfSample;
    if (inside_)
      sample_row_inside(source_->planes[plane], texture, out, run.count());
    else
      sample_row_clamped(source_->planes[plane], texture, out, run.count());
    if (finish_->light != nullptr && plane == 0)
      light_row(out, along(offset_), along(gain_), run.count());
    if (const InteriorMix* mix = finish_->interior)
      mix_interior_row(out, mix->colours[plane], mix->opacity, along(ramp_), run.count());
  }

 private:
  const TriangleSetup* setup_ = nullptr;
  const TextureSource* source_ = nullptr;
  const Finish* finish_ = nullptr;
  Gradient u_, v_, offset_, gain_, ramp_;
  bool inside_ = false;
};

/// Paints runs from one source straight into the target.
class PlainPainter {
 public:
  PlainPainter(const TriangleSetup& setup, const TextureSource& source, const RasterTarget& target)
      : painter_(setup, source), target_(target) {}

  void paint(int row, RowRun run) const {
    for (std::size_t i = 0; i < target_.planes.size(); ++i)
      painter_.paint(i, row, run, target_.planes[i].row(row) + run.first);
  }

 private:
  SourcePainter painter_;
  const RasterTarget& target_;
};

/// Paints runs from several sources, blended. SPEC 11.6.
class BlendPainter {
 public:
  BlendPainter(const TriangleSetup& setup, std::span<const TextureSource> sources, const RasterTarget& target)
      : setup_(setup), count_(sources.size()), target_(target) {
    assert(count_ <= kMaxTriangleSources);
    for (std::size_t s = 0; s < count_; ++s) {
      painters_[s].emplace(setup, sources[s]);
      weights_[s] = setup.gradient(sources[s].weight, 0);
    }
  }

  void paint(int row, RowRun run) const {
    for (RowRun piece{run.first, run.first}; piece.first <= run.last; piece.first += kPiece) {
      piece.last = std::min(run.last, piece.first + kPiece - 1);
      paint_piece(row, piece);
    }
  }

 private:
  static constexpr int kPiece = 64;

  void paint_piece(int row, RowRun run) const {
    const FromCorner at = setup_.from_corner(run.first, row);
    const int n = run.count();
    std::array<std::array<std::int16_t, kPiece>, kMaxTriangleSources> weight;
    std::array<std::int16_t, kPiece> left;
    left.fill(kWeightOne);
    for (std::size_t s = 0; s + 1 < count_; ++s) {
      const Gradient& g = *weights_[s];
      weight_row({g.at(at, setup_.position_bits()), g.dx}, left.data(), weight[s].data(), n);
    }
    weight[count_ - 1] = left;
    std::array<std::uint8_t, kPiece> samples;
    std::array<std::int32_t, kPiece> sum;
    for (std::size_t i = 0; i < target_.planes.size(); ++i) {
      std::fill_n(sum.begin(), n, kWeightOne / 2);
      for (std::size_t s = 0; s < count_; ++s) {
        painters_[s]->paint(i, row, run, samples.data());
        add_weighted_row(samples.data(), weight[s].data(), sum.data(), n);
      }
      std::uint8_t* out = target_.planes[i].row(row) + run.first;
      round_row(sum.data(), out, n);
    }
  }

  const TriangleSetup& setup_;
  std::size_t count_;
  const RasterTarget& target_;
  std::array<std::optional<SourcePainter>, kMaxTriangleSources> painters_;
  std::array<std::optional<Gradient>, kMaxTriangleSources> weights_;
};

template <class Painter>
void for_each_run(const ScreenTriangle& t, const TriangleSetup& setup, const RasterTarget& target,
                  int first_row, int last_row, const Painter& painter) {
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

}  // namespace

void draw_triangle(const ScreenTriangle& t, std::span<const TextureSource> sources,
                   const RasterTarget& target) {
  const TriangleSetup setup(t, target.scale);
  const int first_row = std::max(target.area.y0, setup.first_row()),
            last_row = std::min(target.area.y1 - 1, setup.last_row());
  if (!setup.faces_viewer() || first_row > last_row) return;
  if (sources.size() == 1)
    for_each_run(t, setup, target, first_row, last_row, PlainPainter(setup, sources.front(), target));
  else
    for_each_run(t, setup, target, first_row, last_row, BlendPainter(setup, sources, target));
}

}  // namespace fbs
