#include "decoder/raster/rasteriser.h"

#include <algorithm>
#include <cassert>
#include <memory>
#include <optional>
#include <type_traits>

#include "decoder/raster/blend_weights.h"
#include "decoder/raster/finish.h"
#include "decoder/raster/row_block.h"
#include "decoder/raster/texture_sampler.h"
#include "decoder/raster/triangle_kernels.h"

namespace fbs {
namespace {

constexpr int kDepthBits = 16;  // depth keeps its unit

bool is_lit(const TextureSource& s) {
  return s.finish.light != nullptr || s.finish.light_before != nullptr;
}

/// The samples of one source: everything linear over the triangle except depth.
/// @param kLit  whether there may be light: luma only
template <PlaneScale kScale, bool kLit>
class SourcePainter {
 public:
  SourcePainter(const TriangleSetup& setup, const ScreenTriangle& t, const TextureSource& source)
      : sampler_(setup, t, source.planes, source.corners) {
    if constexpr (kLit) {
      if (source.finish.light != nullptr) finish_.light.emplace(setup, *source.finish.light);
      if (source.finish.light_before != nullptr)
        finish_.light_before.emplace(setup, *source.finish.light_before);
    }
  }

  [[nodiscard]] BlockSamples<kScale> paint(const RowBlock<kScale>& block) const {
    BlockSamples<kScale> samples = sampler_.sample(block);
    if constexpr (kLit) {
      if (finish_.light_before) samples[0] = finish_.light_before->take_back(block, samples[0]);
      if (finish_.light) samples[0] = finish_.light->paint(block, samples[0]);
    }
    return samples;
  }

 private:
  struct Painters {
    std::optional<LightPainter> light_before, light;
  };
  struct Nothing {};

  TextureSampler<kScale> sampler_;
  [[no_unique_address]] std::conditional_t<kLit, Painters, Nothing> finish_;
};

/// One object for each source of a triangle; unused memory is not touched.
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

bool is_constant(const std::array<std::int32_t, 3>& v) {
  return v[0] == v[1] && v[0] == v[2];
}

bool all_constant_and_coarse(std::span<const TextureSource> sources) {
  return std::all_of(sources.begin(), sources.end() - 1, [](const TextureSource& s) {
    return is_constant(s.weight) && s.weight[0] % kCoarseStep == 0;
  });
}

/// Weights constant over the triangle, 2^-8.
template <PlaneScale kScale, bool kLit>
class CoarseBlend {
 public:
  CoarseBlend(const TriangleSetup& setup, const ScreenTriangle& t, std::span<const TextureSource> sources) {
    std::int32_t left = kCoarseOne;
    for (const TextureSource& s : sources) {
      const bool last = &s == &sources.back();
      const std::int32_t weight = last ? left : std::clamp(s.weight[0] / kCoarseStep, 0, left);
      left -= weight;
      if (weight == 0) continue;
      weights_[painters_.size()] = static_cast<std::uint16_t>(weight);
      painters_.add(setup, t, s);
    }
  }

  [[nodiscard]] BlockSamples<kScale> paint(const RowBlock<kScale>& block) const {
    BlockSamples<kScale> sum{};
    for (std::size_t s = 0; s < painters_.size(); ++s) {
      const auto samples = painters_[s].paint(block);
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += samples[i] * weights_[s];
    }
    for (Lanes& lanes : sum) lanes = (lanes + std::uint16_t{kCoarseOne / 2}) >> kCoarseOneLog2;
    return sum;
  }

 private:
  SourceArray<SourcePainter<kScale, kLit>> painters_;
  std::array<std::uint16_t, kMaxTriangleSources> weights_;
};

/// Weights linear over the triangle. SPEC 11.6.
template <PlaneScale kScale, bool kLit>
class LinearBlend {
 public:
  LinearBlend(const TriangleSetup& setup, const ScreenTriangle& t, std::span<const TextureSource> sources) {
    for (const TextureSource& s : sources) {
      painters_.add(setup, t, s);
      if (&s != &sources.back()) weights_.add(setup, s.weight);
    }
  }

  [[nodiscard]] BlockSamples<kScale> paint(const RowBlock<kScale>& block) const {
    std::array<WeightedSum, plane_count(kScale)> sum;
    Lanes left = Lanes{} + std::uint16_t{kWeightOne};
    for (std::size_t s = 0; s < painters_.size(); ++s) {
      const auto samples = painters_[s].paint(block);
      const Lanes weight = s < weights_.size() ? weights_[s].take(block, left) : left;
      for (std::size_t i = 0; i < sum.size(); ++i) {
        if (s % WeightedSum::kMaxAdded == WeightedSum::kMaxAdded - 1) sum[i].carry();
        sum[i].add(samples[i], weight);
      }
    }
    BlockSamples<kScale> out;
    for (std::size_t i = 0; i < sum.size(); ++i) out[i] = sum[i].rounded();
    return out;
  }

 private:
  SourceArray<SourcePainter<kScale, kLit>> painters_;
  SourceArray<LinearWeight<kScale>> weights_;
};

template <PlaneScale kScale>
void store(Lanes samples, const PlaneView& plane, const RowBlock<kScale>& block) {
  std::uint8_t* const out = plane.row(block.row) + block.first;
  if (block.first + kLaneCount <= plane.width) {
    store_first_lanes(samples, out, block.count);
  } else {
    std::array<std::uint8_t, kLaneCount> all;
    store_lanes(samples, all.data());
    std::copy_n(all.begin(), block.count, out);
  }
}

template <PlaneScale kScale, class Painter>
void paint_run(const Painter& painter, const TriangleSetup& setup, int row, RowRun run,
               const RasterTarget& target) {
  for (int first = run.first; first <= run.last; first += kLaneCount) {
    const RowBlock<kScale> block{row, first, std::min(run.last - first + 1, kLaneCount),
                                 setup.from_corner(first, row)};
    const auto samples = painter.paint(block);
    for (std::size_t i = 0; i < samples.size(); ++i) store(samples[i], target.planes[i], block);
  }
}

template <PlaneScale kScale, class Painter>
void paint_rows(const ScreenTriangle& t, const TriangleSetup& setup, const RasterTarget& target,
                const Painter& painter) {
  const int first_row = std::max(target.area.y0, setup.first_row()),
            last_row = std::min(target.area.y1 - 1, setup.last_row());
  Gradient z;
  if (target.depth != nullptr) z = setup.gradient({t[0].depth, t[1].depth, t[2].depth}, kDepthBits);
  for (int row = first_row; row <= last_row; ++row) {
    const RowRun run = covered_run(setup, row, target.area);
    if (run.empty()) continue;
    if (target.depth == nullptr)
      paint_run<kScale>(painter, setup, row, run, target);
    else
      for_each_nearer(target.depth->row(row), run,
                      {z.at(setup.from_corner(run.first, row), setup.position_bits()), z.dx},
                      [&](RowRun nearer) { paint_run<kScale>(painter, setup, row, nearer, target); });
  }
}

template <PlaneScale kScale, bool kLit>
void draw(const ScreenTriangle& t, std::span<const TextureSource> sources, const RasterTarget& target) {
  const TriangleSetup setup(t, kScale);
  if (!setup.faces_viewer() || setup.last_row() < target.area.y0 || setup.first_row() >= target.area.y1)
    return;
  if (const auto triangle = shorten(setup, t, sources, target))
    return draw_short_triangle(*triangle, kScale, sources, target.planes, *target.depth);
  if (sources.size() == 1)
    paint_rows<kScale>(t, setup, target, SourcePainter<kScale, kLit>(setup, t, sources.front()));
  else if (all_constant_and_coarse(sources))
    paint_rows<kScale>(t, setup, target, CoarseBlend<kScale, kLit>(setup, t, sources));
  else
    paint_rows<kScale>(t, setup, target, LinearBlend<kScale, kLit>(setup, t, sources));
}

}  // namespace

void draw_triangle(const ScreenTriangle& t, std::span<const TextureSource> sources,
                   const RasterTarget& target) {
  assert(!sources.empty() && sources.size() <= kMaxTriangleSources);
  assert(target.planes.size() == plane_count(target.scale));
  if (target.scale == PlaneScale::kChroma)
    draw<PlaneScale::kChroma, false>(t, sources, target);
  else if (std::any_of(sources.begin(), sources.end(), is_lit))
    draw<PlaneScale::kLuma, true>(t, sources, target);
  else
    draw<PlaneScale::kLuma, false>(t, sources, target);
}

}  // namespace fbs
