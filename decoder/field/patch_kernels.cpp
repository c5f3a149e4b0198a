#include "decoder/field/patch_kernels.h"

#include <algorithm>
#include <bit>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "decoder/field/patch_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each kind of processor
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace fbs {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// What each of the three nodes of a row of a block has of the weight at a sample, in eighths.
struct Ramps {
  alignas(32) std::uint16_t of[3][16];
};
constexpr Ramps kLumaRamps = {{{8, 7, 6, 5, 4, 3, 2, 1},
                               {0, 1, 2, 3, 4, 5, 6, 7, 8, 7, 6, 5, 4, 3, 2, 1},
                               {0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7}}};
constexpr Ramps kChromaRamps = {{{8, 6, 4, 2}, {0, 2, 4, 6, 8, 6, 4, 2}, {0, 0, 0, 0, 0, 2, 4, 6}}};

/// Blends some columns of a block.
/// @param kStep  luma samples per sample
/// @param x      the first column; those of a vector follow
template <int kStep, class D>
HWY_INLINE void blend_columns(D d, std::span<const BlendedSource> sources, const Ramps& ramps, std::size_t x,
                              std::uint8_t* out, std::ptrdiff_t stride) {
  using V = hn::Vec<D>;
  constexpr int kRows = kPatchSize / kStep;
  const hn::Rebind<std::uint8_t, D> bytes;
  const V ramp0 = hn::Load(d, ramps.of[0] + x), ramp1 = hn::Load(d, ramps.of[1] + x),
          ramp2 = hn::Load(d, ramps.of[2] + x);
  const auto across = [&](const std::uint16_t* node) HWY_ATTR {
    return hn::Add(hn::Add(hn::Mul(hn::Set(d, node[0]), ramp0), hn::Mul(hn::Set(d, node[1]), ramp1)),
                   hn::Mul(hn::Set(d, node[2]), ramp2));
  };
  for (int patch = 0; patch < 2; ++patch) {
    const int first_row = patch * kRows;
    V a = hn::Set(d, 32), b = a, c = a, e = a, f = a, g = a, h = a, i = a;  // sums in 1/64 of a level
    for (const BlendedSource& s : sources) {
      const V top = across(s.weight.data() + 3 * patch), bottom = across(s.weight.data() + 3 * patch + 3);
      const V step = hn::Mul(hn::Sub(bottom, top), hn::Set(d, kStep));
      V weight = hn::ShiftLeft<3>(top);  // 2^-14
      const std::uint8_t* row = s.block.samples + first_row * s.block.stride + x;
      const auto add = [&](V& sum) HWY_ATTR {
        const V sample = hn::ShiftLeft<8>(hn::PromoteTo(d, hn::LoadU(bytes, row)));
        sum = hn::Add(sum, hn::MulHigh(sample, weight));
        weight = hn::Add(weight, step);
        row += s.block.stride;
      };
      add(a), add(b), add(c), add(e);
      if constexpr (kRows == 8) add(f), add(g), add(h), add(i);
    }
    std::uint8_t* row = out + first_row * stride + x;
    const auto store = [&](V sum) HWY_ATTR {
      hn::StoreU(hn::DemoteTo(bytes, hn::BitCast(hn::RebindToSigned<D>(), hn::ShiftRight<6>(sum))), bytes,
                 row);
      row += stride;
    };
    store(a), store(b), store(c), store(e);
    if constexpr (kRows == 8) store(f), store(g), store(h), store(i);
  }
}

void blend_luma(std::span<const BlendedSource> sources, std::uint8_t* out, std::ptrdiff_t stride) {
  const hn::CappedTag<std::uint16_t, 16> d;
  for (std::size_t x = 0; x < 16; x += hn::Lanes(d)) blend_columns<1>(d, sources, kLumaRamps, x, out, stride);
}

void blend_chroma(std::span<const BlendedSource> sources, std::uint8_t* out, std::ptrdiff_t stride) {
  const hn::CappedTag<std::uint16_t, 8> d;
  for (std::size_t x = 0; x < 8; x += hn::Lanes(d))
    blend_columns<2>(d, sources, kChromaRamps, x, out, stride);
}

/// Between the upper and the lower samples, each already between left and right.
template <class D, class V>
HWY_INLINE V between(D d, V top, V bottom, V fraction) {
  // The product is rounded to the nearest and halved twice less than it seems: Q15 times 2^9.
  const V more = hn::MulFixedPoint15(hn::Sub(bottom, top), hn::ShiftLeft<15 - kFractionOneLog2>(fraction));
  return hn::ShiftRight<kFractionOneLog2>(
      hn::Add(hn::Add(top, more), hn::Set(d, 1 << (kFractionOneLog2 - 1))));
}

template <class D>
HWY_INLINE void warp_columns(D d, const std::uint8_t* from, std::ptrdiff_t stride, glm::ivec2 fraction,
                             int rows, std::uint8_t* out) {
  using V = hn::Vec<D>;
  const hn::Rebind<std::uint8_t, D> bytes;
  const V right = hn::Set(d, static_cast<std::int16_t>(fraction.x)),
          left = hn::Set(d, static_cast<std::int16_t>((1 << kFractionOneLog2) - fraction.x)),
          down = hn::Set(d, static_cast<std::int16_t>(fraction.y));
  const auto across = [&]() HWY_ATTR {
    return hn::Add(hn::Mul(hn::PromoteTo(d, hn::LoadU(bytes, from)), left),
                   hn::Mul(hn::PromoteTo(d, hn::LoadU(bytes, from + 1)), right));
  };
  V top = across();
  for (int y = 0; y < rows; ++y) {
    from += stride;
    const V bottom = across();
    hn::StoreU(hn::DemoteTo(bytes, between(d, top, bottom, down)), bytes, out);
    out += WarpedBlock::kStride;
    top = bottom;
  }
}

void sample_even(const std::uint8_t* from, std::ptrdiff_t stride, glm::ivec2 fraction, glm::ivec2 size,
                 std::uint8_t* out) {
  const hn::CappedTag<std::int16_t, 16> wide;
  const hn::CappedTag<std::int16_t, 8> d;
  int x = 0;
  for (const int n = static_cast<int>(hn::Lanes(wide)); x + n <= size.x; x += n)
    warp_columns(wide, from + x, stride, fraction, size.y, out + x);
  for (const int n = static_cast<int>(hn::Lanes(d)); x < size.x; x += n)
    warp_columns(d, from + x, stride, fraction, size.y, out + x);
}

/// Where the eight samples of a step lie that are drawn together.
struct Lanes8 {
  alignas(32) std::int32_t column[8], row[8];  ///< in the patch, samples
};
constexpr Lanes8 kLumaLanes = {{0, 1, 2, 3, 4, 5, 6, 7}, {}};
constexpr Lanes8 kChromaLanes = {{0, 1, 2, 3, 0, 1, 2, 3}, {0, 0, 0, 0, 1, 1, 1, 1}};

/// Where eight samples are in a texture.
struct Places8 {
  alignas(32) std::int32_t offset[8];
  alignas(16) std::int16_t right[8], down[8];  ///< fractions
};

HWY_INLINE void sample_eight(const std::uint8_t* from, std::ptrdiff_t stride, const Places8& places,
                             std::uint8_t* out) {
  alignas(16) std::uint16_t top[8], bottom[8];
  for (int k = 0; k < 8; ++k) {
    const std::uint8_t* const at = from + places.offset[k];
    std::memcpy(top + k, at, sizeof *top);
    std::memcpy(bottom + k, at + stride, sizeof *bottom);
  }
  const hn::CappedTag<std::uint16_t, 8> d;
  const hn::RebindToSigned<decltype(d)> s;
  const hn::Rebind<std::uint8_t, decltype(d)> bytes;
  for (std::size_t k = 0; k < 8; k += hn::Lanes(d)) {
    const auto right = hn::BitCast(d, hn::Load(s, places.right + k)),
               left = hn::Sub(hn::Set(d, 1 << kFractionOneLog2), right);
    const auto across = [&](const std::uint16_t* pairs) HWY_ATTR {
      const auto pair = hn::Load(d, pairs);
      const auto low = hn::And(pair, hn::Set(d, 255)), high = hn::ShiftRight<8>(pair);
      const bool is_little = std::endian::native == std::endian::little;
      return hn::BitCast(
          s, hn::Add(hn::Mul(is_little ? low : high, left), hn::Mul(is_little ? high : low, right)));
    };
    const auto sample = between(s, across(top + k), across(bottom + k), hn::Load(s, places.down + k));
    hn::StoreU(hn::DemoteTo(bytes, sample), bytes, out + k);
  }
}

/// One coordinate of a displacement at the four nodes, in PatchNodes' order.
using NodeValues = std::array<std::int32_t, 4>;

/// Finds the places of all samples of a patch, eight at a time. No vector is the member of a class: those of
/// SVE have no size.
/// @param kStep  luma samples per sample
template <int kStep, std::size_t kSteps>
HWY_INLINE void find_places(std::ptrdiff_t stride, const PatchNodes& nodes,
                            std::array<Places8, kSteps>& out) {
  constexpr int kHalved = kStep == 1 ? 0 : 1, kRowsPerStep = kStep == 1 ? 1 : 2;
  const Lanes8& lanes = kStep == 1 ? kLumaLanes : kChromaLanes;
  const hn::CappedTag<std::int32_t, 8> d;
  using V = hn::Vec<decltype(d)>;
  const hn::Rebind<std::int16_t, decltype(d)> narrow;
  const NodeValues by_x{nodes[0].x, nodes[1].x, nodes[2].x, nodes[3].x},
      by_y{nodes[0].y, nodes[1].y, nodes[2].y, nodes[3].y};
  const V mask = hn::Set(d, (1 << kFractionOneLog2) - 1);
  for (std::size_t k = 0; k < 8; k += hn::Lanes(d)) {
    const V column = hn::Load(d, lanes.column + k), row = hn::Load(d, lanes.row + k);
    const auto along = [&](std::int32_t left, std::int32_t right) HWY_ATTR {
      return hn::Add(hn::Set(d, 8 * left), hn::Mul(hn::Set(d, (right - left) * kStep), column));
    };
    const auto per_row = [&](const NodeValues& v)
                             HWY_ATTR { return hn::Mul(along(v[2] - v[0], v[3] - v[1]), hn::Set(d, kStep)); };
    const auto at_first = [&](const NodeValues& v) HWY_ATTR {
      return hn::Add(hn::Add(hn::ShiftLeft<3>(along(v[0], v[1])), hn::Mul(per_row(v), row)), hn::Set(d, 32));
    };
    V sum_x = at_first(by_x), sum_y = at_first(by_y);
    const V step_x = hn::Mul(per_row(by_x), hn::Set(d, kRowsPerStep)),
            step_y = hn::Mul(per_row(by_y), hn::Set(d, kRowsPerStep));
    const V x = hn::ShiftLeft<kFractionOneLog2>(column);
    V y = hn::ShiftLeft<kFractionOneLog2>(row);
    for (Places8& p : out) {
      const V u = hn::Add(x, hn::ShiftRight<6 + kHalved>(sum_x)),
              v = hn::Add(y, hn::ShiftRight<6 + kHalved>(sum_y));
      const V rows =
          hn::Mul(hn::ShiftRight<kFractionOneLog2>(v), hn::Set(d, static_cast<std::int32_t>(stride)));
      hn::Store(hn::Add(rows, hn::ShiftRight<kFractionOneLog2>(u)), d, p.offset + k);
      hn::Store(hn::DemoteTo(narrow, hn::And(u, mask)), narrow, p.right + k);
      hn::Store(hn::DemoteTo(narrow, hn::And(v, mask)), narrow, p.down + k);
      sum_x = hn::Add(sum_x, step_x);
      sum_y = hn::Add(sum_y, step_y);
      y = hn::Add(y, hn::Set(d, kRowsPerStep << kFractionOneLog2));
    }
  }
}

void sample_bent_luma(const std::uint8_t* from, std::ptrdiff_t stride, const PatchNodes& nodes,
                      std::uint8_t* out) {
  alignas(32) std::array<Places8, 8> rows;
  find_places<1>(stride, nodes, rows);
  for (const Places8& places : rows) {
    sample_eight(from, stride, places, out);
    out += WarpedBlock::kStride;
  }
}

void sample_bent_chroma(const std::array<const std::uint8_t*, 2>& from, std::ptrdiff_t stride,
                        const PatchNodes& nodes, const std::array<std::uint8_t*, 2>& out) {
  alignas(32) std::array<Places8, 2> pairs;  // of rows
  find_places<2>(stride, nodes, pairs);
  for (std::size_t plane = 0; plane < 2; ++plane) {
    std::uint8_t* to = out[plane];
    for (const Places8& places : pairs) {
      std::uint8_t both[8];
      sample_eight(from[plane], stride, places, both);
      std::memcpy(to, both, 4);
      std::memcpy(to + WarpedBlock::kStride, both + 4, 4);
      to += 2 * WarpedBlock::kStride;
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace fbs
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fbs {

HWY_EXPORT(blend_luma);
HWY_EXPORT(blend_chroma);
HWY_EXPORT(sample_even);
HWY_EXPORT(sample_bent_luma);
HWY_EXPORT(sample_bent_chroma);

void blend_luma_block(std::span<const BlendedSource> sources, std::uint8_t* out, std::ptrdiff_t stride) {
  HWY_DYNAMIC_DISPATCH(blend_luma)(sources, out, stride);
}

void blend_chroma_block(std::span<const BlendedSource> sources, std::uint8_t* out, std::ptrdiff_t stride) {
  HWY_DYNAMIC_DISPATCH(blend_chroma)(sources, out, stride);
}

void warp_even(const std::uint8_t* from, std::ptrdiff_t stride, glm::ivec2 fraction, glm::ivec2 size,
               std::uint8_t* out) {
  HWY_DYNAMIC_DISPATCH(sample_even)(from, stride, fraction, size, out);
}

void warp_bent_luma(const std::uint8_t* from, std::ptrdiff_t stride, const PatchNodes& nodes,
                    std::uint8_t* out) {
  HWY_DYNAMIC_DISPATCH(sample_bent_luma)(from, stride, nodes, out);
}

void warp_bent_chroma(const std::array<const std::uint8_t*, 2>& from, std::ptrdiff_t stride,
                      const PatchNodes& nodes, const std::array<std::uint8_t*, 2>& out) {
  HWY_DYNAMIC_DISPATCH(sample_bent_chroma)(from, stride, nodes, out);
}

void copy_samples(SampleBlock from, glm::ivec2 size, std::uint8_t* out, std::ptrdiff_t stride) {
  for (int y = 0; y < size.y; ++y, from.samples += from.stride, out += stride)
    std::copy_n(from.samples, size.x, out);
}

void draw_blend(std::size_t plane, std::span<const BlendedSource> sources, glm::ivec2 size, std::uint8_t* out,
                std::ptrdiff_t stride) {
  if (sources.size() == 1) return copy_samples(sources.front().block, size, out, stride);
  const auto blend = plane == 0 ? blend_luma_block : blend_chroma_block;
  const int block = plane == 0 ? kBlockSize : kChromaBlockSize;
  if (size == glm::ivec2(block)) return blend(sources, out, stride);
  WarpedBlock whole;
  blend(sources, whole.samples.data(), WarpedBlock::kStride);
  copy_samples({whole.samples.data(), WarpedBlock::kStride}, size, out, stride);
}

}  // namespace fbs
#endif
