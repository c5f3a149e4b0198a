#include "decoder/field/blend_kernels.h"

#include <algorithm>

#include "decoder/field/blend_kernels_plain.h"
#include "decoder/field/warped_block.h"
#include "decoder/vectors/fixed_vectors.h"
#include "decoder/vectors/scalar.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "decoder/field/blend_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each kind of processor
#include <hwy/highway.h>

#include "decoder/vectors/two_planes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fbs {
namespace HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_SCALAR

void blend_luma(std::span<const BlendedSource> sources, NodeSteps steps, std::uint8_t* out,
                std::ptrdiff_t stride) {
  plain::blend_luma_block(sources, steps, out, stride);
}
void blend_chroma(std::span<const BlendedSource> sources, NodeSteps steps,
                  const std::array<std::uint8_t*, 2>& out, std::ptrdiff_t stride) {
  plain::blend_chroma_block(sources, steps, out, stride);
}

#else

namespace hn = hwy::HWY_NAMESPACE;

/// Shares of the three nodes of a line of a block in the weight at a sample, in eighths.
struct Ramps {
  alignas(32) std::uint16_t of[3][16];
};
constexpr Ramps kLumaRamps = {{{8, 7, 6, 5, 4, 3, 2, 1},
                               {0, 1, 2, 3, 4, 5, 6, 7, 8, 7, 6, 5, 4, 3, 2, 1},
                               {0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7}}};
/// For U and V.
constexpr Ramps kChromaRamps = {{{8, 6, 4, 2, 0, 0, 0, 0, 8, 6, 4, 2, 0, 0, 0, 0},
                                 {0, 2, 4, 6, 8, 6, 4, 2, 0, 2, 4, 6, 8, 6, 4, 2},
                                 {0, 0, 0, 0, 0, 2, 4, 6, 0, 0, 0, 0, 0, 2, 4, 6}}};

/// Some columns of a block: one vector.
template <class D>
class Columns {
 public:
  using V = hn::Vec<D>;
  HWY_INLINE Columns(D d, const Ramps& ramps, std::size_t first)
      : d_(d),
        left_(hn::Load(d, ramps.of[0] + first)),
        middle_(hn::Load(d, ramps.of[1] + first)),
        right_(hn::Load(d, ramps.of[2] + first)) {}

  /// Weights along a line of nodes, in 2^-11.
  HWY_INLINE V along(const std::uint16_t* node, NodeSteps steps) const {
    return hn::Add(
        hn::Add(hn::Mul(hn::Set(d_, node[0]), left_), hn::Mul(hn::Set(d_, node[steps.column]), middle_)),
        hn::Mul(hn::Set(d_, node[2 * steps.column]), right_));
  }

 private:
  D d_;
  V left_, middle_, right_;
};

/// Blends the rows of two patches, one above the other.
/// @param kRows  of a patch
/// @param load   loads a row of the block from a source
/// @param store  stores samples of a row, given its number
template <int kRows, class D, class Load, class Store>
HWY_INLINE void blend_columns(D d, std::span<const BlendedSource> sources, NodeSteps steps,
                              const Columns<D>& columns, Load&& load, Store&& store) {
  using V = hn::Vec<D>;
  constexpr int kStepLog2 = kRows == kPatchSize ? 0 : 1;
  const hn::Rebind<std::uint8_t, D> bytes;
  for (int patch = 0; patch < 2; ++patch) {
    const int first = patch * kRows;
    V a = hn::Set(d, 32), b = a, c = a, e = a, f = a, g = a, h = a, i = a;  // sums in 1/64 of a level
    for (const BlendedSource& s : sources) {
      const std::uint16_t* const node = s.weight + patch * steps.line;
      const V top = columns.along(node, steps), bottom = columns.along(node + steps.line, steps);
      const V step = hn::ShiftLeft<kStepLog2>(hn::Sub(bottom, top));
      V weight = hn::ShiftLeft<3>(top);  // 2^-14
      int row = first;
      const auto add = [&](V& sum) HWY_ATTR {
        const V sample = hn::ShiftLeft<8>(hn::PromoteTo(d, load(s, row++)));
        sum = hn::Add(sum, hn::MulHigh(sample, weight));
        weight = hn::Add(weight, step);
      };
      add(a), add(b), add(c), add(e);
      if constexpr (kRows == 8) add(f), add(g), add(h), add(i);
    }
    int row = first;
    const auto put = [&](V sum) HWY_ATTR {
      store(hn::DemoteTo(bytes, hn::BitCast(hn::RebindToSigned<D>(), hn::ShiftRight<6>(sum))), row++);
    };
    put(a), put(b), put(c), put(e);
    if constexpr (kRows == 8) put(f), put(g), put(h), put(i);
  }
}

void blend_luma(std::span<const BlendedSource> sources, NodeSteps steps, std::uint8_t* out,
                std::ptrdiff_t stride) {
  const hn::CappedTag<std::uint16_t, kBlockSize> d;
  const hn::Rebind<std::uint8_t, decltype(d)> bytes;
  for (std::size_t x = 0; x < kBlockSize; x += hn::Lanes(d))
    blend_columns<kPatchSize>(
        d, sources, steps, Columns(d, kLumaRamps, x),
        [&](const BlendedSource& s, int row)
            HWY_ATTR { return hn::LoadU(bytes, s.planes[0].samples + row * s.planes[0].stride + x); },
        [&](auto samples, int row) HWY_ATTR { hn::StoreU(samples, bytes, out + row * stride + x); });
}

void blend_chroma(std::span<const BlendedSource> sources, NodeSteps steps,
                  const std::array<std::uint8_t*, 2>& out, std::ptrdiff_t stride) {
  const hn::CappedTag<std::uint16_t, 2 * kChromaBlockSize> d;
  for (std::size_t x = 0; x < 2 * kChromaBlockSize; x += hn::Lanes(d))
    blend_columns<kPatchSize / 2>(
        d, sources, steps, Columns(d, kChromaRamps, x),
        [&](const BlendedSource& s, int row) HWY_ATTR {
          const std::ptrdiff_t at = row * s.planes[1].stride;
          return load_two(d, x, s.planes[1].samples + at, s.planes[2].samples + at);
        },
        [&](auto samples, int row)
            HWY_ATTR { store_two(d, x, samples, out[0] + row * stride, out[1] + row * stride); });
}

#endif

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace fbs
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fbs {

HWY_EXPORT(blend_luma);
HWY_EXPORT(blend_chroma);

void blend_luma_block(std::span<const BlendedSource> sources, NodeSteps steps, std::uint8_t* out,
                      std::ptrdiff_t stride) {
  FBS_DISPATCH(blend_luma, plain::blend_luma_block)(sources, steps, out, stride);
}

void blend_chroma_block(std::span<const BlendedSource> sources, NodeSteps steps,
                        const std::array<std::uint8_t*, 2>& out, std::ptrdiff_t stride) {
  FBS_DISPATCH(blend_chroma, plain::blend_chroma_block)(sources, steps, out, stride);
}

void copy_samples(SampleBlock from, glm::ivec2 size, std::uint8_t* out, std::ptrdiff_t stride) {
  for (int y = 0; y < size.y; ++y, from.samples += from.stride, out += stride)
    std::copy_n(from.samples, size.x, out);
}

namespace {

std::uint8_t* place_in(const PlaneView& plane, glm::ivec2 first) {
  return plane.data + first.y * plane.stride + first.x;
}

}  // namespace

void draw_blend(std::span<const BlendedSource> sources, NodeSteps steps, glm::ivec2 block,
                const std::array<PlaneView, 3>& target) {
  const bool has_chroma = target[1].data != nullptr;
  const glm::ivec2 luma = block * kBlockSize, chroma = block * kChromaBlockSize;
  const glm::ivec2 luma_size = size_inside(luma, kBlockSize, target[0]),
                   chroma_size =
                       has_chroma ? size_inside(chroma, kChromaBlockSize, target[1]) : glm::ivec2(0);
  std::uint8_t* const y = place_in(target[0], luma);
  const std::array<std::uint8_t*, 2> uv =
      has_chroma ? std::array{place_in(target[1], chroma), place_in(target[2], chroma)}
                 : std::array<std::uint8_t*, 2>{};
  if (sources.size() == 1) {
    const auto& planes = sources.front().planes;
    copy_samples(planes[0], luma_size, y, target[0].stride);
    for (std::size_t k = 0; k < 2 && has_chroma; ++k)
      copy_samples(planes[1 + k], chroma_size, uv[k], target[1 + k].stride);
    return;
  }
  WarpedBlock whole[2];
  if (luma_size == glm::ivec2(kBlockSize)) {
    blend_luma_block(sources, steps, y, target[0].stride);
  } else {
    blend_luma_block(sources, steps, whole[0].samples.data(), WarpedBlock::kStride);
    copy_samples({whole[0].samples.data(), WarpedBlock::kStride}, luma_size, y, target[0].stride);
  }
  if (!has_chroma) return;
  if (chroma_size == glm::ivec2(kChromaBlockSize) && target[1].stride == target[2].stride) {
    blend_chroma_block(sources, steps, uv, target[1].stride);
    return;
  }
  blend_chroma_block(sources, steps, {whole[0].samples.data(), whole[1].samples.data()},
                     WarpedBlock::kStride);
  for (std::size_t k = 0; k < 2; ++k)
    copy_samples({whole[k].samples.data(), WarpedBlock::kStride}, chroma_size, uv[k], target[1 + k].stride);
}

}  // namespace fbs
#endif
