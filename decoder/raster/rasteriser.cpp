#include "decoder/raster/rasteriser.h"

#include <algorithm>
#include <cassert>
#include <memory>
#include <optional>
#include <type_traits>

#include "decoder/raster/blend_weights.h"
#include "decoder/raster/finish_rows.h"
#include "decoder/raster/row_block.h"
#include "decoder/raster/texture_sampler.h"

namespace fbs {
namespace {

constexpr int kDepthBits = 16;  // depth keeps its unit

/// Light and mouth interior on the samples of one source.
class Finisher {
 public:
  Finisher(const TriangleSetup& setup, const Finish& finish) : finish_(finish), bits_(setup.position_bits()) {
    if (finish.light != nullptr) {
      offset_ = setup.gradient(finish.light->offset, 0);
      gain_ = setup.gradient(finish.light->gain, 0);
    }
    if (finish.interior != nullptr) ramp_ = setup.gradient(finish.interior->ramp, 0);
  }

  void finish(const RowBlock& block, std::size_t planes, BlockSamples& samples) const {
    for (std::size_t i = 0; i < planes; ++i) {
      std::array<std::uint8_t, kLaneCount> row;
      store_lanes(samples[i], row.data());
      if (finish_.light != nullptr && i == 0)
        light_row(row.data(), along(offset_, block), along(gain_, block), block.count);
      if (const InteriorMix* mix = finish_.interior)
        mix_interior_row(row.data(), mix->colours[i], mix->opacity, along(ramp_, block), block.count);
      samples[i] = load_lanes(row.data());
    }
  }

 private:
  [[nodiscard]] LinearRow along(const Gradient& g, const RowBlock& block) const {
    return {g.at(block.at, bits_), g.dx};
  }

  const Finish& finish_;
  int bits_;
  Gradient offset_, gain_, ramp_;
};

/// The samples of one source: everything that is linear over the triangle but depth.
class SourcePainter {
 public:
  SourcePainter(const TriangleSetup& setup, const TextureSource& source)
      : sampler_(setup, source.planes, source.corners), planes_(source.planes.size()) {
    if (source.finish.light != nullptr || source.finish.interior != nullptr) finisher_.emplace(setup, source.finish);
  }

  [[nodiscard]] BlockSamples paint(const RowBlock& block) const {
    BlockSamples samples = sampler_.sample(block);
    if (finisher_) finisher_->finish(block, planes_, samples);
    return samples;
  }

 private:
  TextureSampler sampler_;
  std::size_t planes_;
  std::optional<Finisher> finisher_;
};

bool is_constant(const std::array<std::int32_t, 3>& v) {
  return v[0] == v[1] && v[0] == v[2];
}

/// One of each source of a triangle; memory that is not used is not touched.
template <class T>
class SourceArray {
  static_assert(std::is_trivially_destructible_v<T>);

 public:
  SourceArray() {}  // NOLINT(modernize-use-equals-default): not even zeroed
  template <class... Arguments>
  void add(Arguments&&... arguments) {
    std::construct_at(&items_[count_++].item, std::forward<Arguments>(arguments)...);
  }
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return items_[i].item; }

 private:
  union Place {
    Place() {}  // NOLINT(modernize-use-equals-default)
    T item;
  };
  std::array<Place, kMaxTriangleSources> items_;
  std::size_t count_ = 0;
};

/// Weights that are the same all over the triangle, 2^-8.
class CoarseBlend {
 public:
  static bool serves(std::span<const TextureSource> sources) {
    return std::all_of(sources.begin(), sources.end() - 1, [](const TextureSource& s) {
      return is_constant(s.weight) && s.weight[0] % kCoarseStep == 0;
    });
  }

  CoarseBlend(const TriangleSetup& setup, std::span<const TextureSource> sources) {
    std::int32_t left = kCoarseOne;
    for (const TextureSource& s : sources) {
      const bool last = &s == &sources.back();
      const std::int32_t weight = last ? left : std::clamp(s.weight[0] / kCoarseStep, 0, left);
      left -= weight;
      if (weight == 0) continue;
      weights_[painters_.size()] = static_cast<std::uint16_t>(weight);
      painters_.add(setup, s);
    }
  }

  [[nodiscard]] BlockSamples paint(const RowBlock& block) const {
    BlockSamples sum{};
    for (std::size_t s = 0; s < painters_.size(); ++s) {
      const BlockSamples samples = painters_[s].paint(block);
      for (std::size_t i = 0; i < kMaxPlanes; ++i) sum[i] += samples[i] * weights_[s];
    }
    for (Lanes& lanes : sum) lanes = (lanes + kCoarseOne / 2) >> kCoarseOneLog2;
    return sum;
  }

 private:
  SourceArray<SourcePainter> painters_;
  std::array<std::uint16_t, kMaxTriangleSources> weights_;
};

/// Weights that are linear over the triangle. SPEC 11.6.
class LinearBlend {
 public:
  LinearBlend(const TriangleSetup& setup, std::span<const TextureSource> sources) {
    for (const TextureSource& s : sources) {
      painters_.add(setup, s);
      if (&s != &sources.back()) weights_.add(setup, s.weight);
    }
  }

  [[nodiscard]] BlockSamples paint(const RowBlock& block) const {
    std::array<WeightedSum, kMaxPlanes> sum;
    Lanes left = Lanes{} + kWeightOne;
    for (std::size_t s = 0; s < painters_.size(); ++s) {
      const BlockSamples samples = painters_[s].paint(block);
      const Lanes weight = s < weights_.size() ? weights_[s].take(block, left) : left;
      for (std::size_t i = 0; i < kMaxPlanes; ++i) sum[i].add(samples[i], weight);
    }
    BlockSamples out;
    for (std::size_t i = 0; i < kMaxPlanes; ++i) out[i] = sum[i].samples();
    return out;
  }

 private:
  SourceArray<SourcePainter> painters_;
  SourceArray<LinearWeight> weights_;
};

template <class Painter>
void paint_run(const Painter& painter, const TriangleSetup& setup, int row, RowRun run, const RasterTarget& target) {
  for (int first = run.first; first <= run.last; first += kLaneCount) {
    const RowBlock block{row, first, std::min(run.last - first + 1, kLaneCount), setup.from_corner(first, row)};
    const BlockSamples samples = painter.paint(block);
    for (std::size_t i = 0; i < target.planes.size(); ++i)
      store_lanes(samples[i], target.planes[i].row(row) + first, block.count);
  }
}

template <class Painter>
void paint_rows(const ScreenTriangle& t, const TriangleSetup& setup, const RasterTarget& target,
                  int first_row, int last_row, const Painter& painter) {
  Gradient z;
  if (target.depth != nullptr) z = setup.gradient({t[0].depth, t[1].depth, t[2].depth}, kDepthBits);
  for (int row = first_row; row <= last_row; ++row) {
    const RowRun run = covered_run(setup, row, target.area);
    if (run.empty()) continue;
    if (target.depth == nullptr)
      paint_run(painter, setup, row, run, target);
    else
      for_each_nearer(target.depth->row(row), run,
                      {z.at(setup.from_corner(run.first, row), setup.position_bits()), z.dx},
                      [&](RowRun nearer) { paint_run(painter, setup, row, nearer, target); });
  }
}

}  // namespace

void draw_triangle(const ScreenTriangle& t, std::span<const TextureSource> sources,
                   const RasterTarget& target) {
  assert(!sources.empty() && sources.size() <= kMaxTriangleSources);
  const TriangleSetup setup(t, target.scale);
  const int first_row = std::max(target.area.y0, setup.first_row()),
            last_row = std::min(target.area.y1 - 1, setup.last_row());
  if (!setup.faces_viewer() || first_row > last_row) return;
  if (sources.size() == 1)
    paint_rows(t, setup, target, first_row, last_row, SourcePainter(setup, sources.front()));
  else if (CoarseBlend::serves(sources))
    paint_rows(t, setup, target, first_row, last_row, CoarseBlend(setup, sources));
  else
    paint_rows(t, setup, target, first_row, last_row, LinearBlend(setup, sources));
}

}  // namespace fbs
