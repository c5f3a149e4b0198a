#include "encoder/blend/sample_kernels.h"

#include <algorithm>

#include "decoder/vectors/fixed_vectors.h"
#include "decoder/vectors/scalar.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "encoder/blend/sample_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each kind of processor
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace fbs {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, ShownSamples::kLanes>;
using Integers = hn::RebindToSigned<Lanes>;
using Values = hn::Vec<Lanes>;

HWY_INLINE Values constant(float value) {
  return hn::Set(Lanes(), value);
}

/// Values at the first samples of runs.
HWY_INLINE Values at_first(const TriangleValue& v, Values row, Values first) {
  return hn::Add(hn::Add(constant(v.origin), hn::Mul(first, constant(v.per_column))),
                 hn::Mul(row, constant(v.per_row)));
}

HWY_INLINE Values along(const TriangleValue& v, Values row, Values first, Values step) {
  return hn::Add(at_first(v, row, first), hn::Mul(step, constant(v.per_column)));
}

/// Where samples are interpolated along one axis.
struct Axis {
  hn::Vec<Integers> cell;
  Values share;  ///< of the next sample
  /// @param size  of the plane
  HWY_INLINE Axis(Values at, float inset, int size) {
    const Integers integers;
    const Values inside =
        hn::Min(hn::Max(at, constant(inset)), constant(static_cast<float>(size - 1) - inset));
    cell = hn::Min(hn::ConvertTo(integers, inside), hn::Set(integers, size - 2));
    share = hn::Sub(inside, hn::ConvertTo(Lanes(), cell));
  }
};

/// a + share * (b - a)
template <class V>
HWY_INLINE V between(V a, V b, V share) {
  return hn::Add(a, hn::Mul(share, hn::Sub(b, a)));
}

#if HWY_TARGET == HWY_SCALAR

HWY_INLINE Values between_pairs(Lanes lanes, const float* samples, const std::uint32_t* at, Values share) {
  return between(hn::LoadU(lanes, samples + *at), hn::LoadU(lanes, samples + *at + 1), share);
}

#else

using Quad = hn::CappedTag<float, 4>;

/// Pairs of samples at two indices.
HWY_INLINE hn::Vec<Quad> two_pairs(const float* samples, const std::uint32_t* at) {
  const hn::Half<Quad> pair;
  return hn::Combine(Quad(), hn::LoadU(pair, samples + at[1]), hn::LoadU(pair, samples + at[0]));
}

/// Interpolates between the samples at these indices and those behind them. Processors gather lane by lane,
/// so pairs take half the time.
template <class D>
HWY_INLINE hn::Vec<D> between_pairs(D lanes, const float* samples, const std::uint32_t* at,
                                    hn::Vec<D> share) {
  const Quad quad;
  const auto a = two_pairs(samples, at), b = two_pairs(samples, at + 2);
  const auto left = hn::ConcatEven(quad, b, a), right = hn::ConcatOdd(quad, b, a);
  if constexpr (hn::MaxLanes(D()) == 4) {
    (void)lanes;
    return between(left, right, share);
  } else {
    const auto c = two_pairs(samples, at + 4), d = two_pairs(samples, at + 6);
    return between(hn::Combine(lanes, hn::ConcatEven(quad, d, c), left),
                   hn::Combine(lanes, hn::ConcatOdd(quad, d, c), right), share);
  }
}

#endif

HWY_INLINE Values interpolated(const ReducedPlane& plane, const Axis& x, const Axis& y) {
  const Integers integers;
  const hn::RebindToUnsigned<Lanes> indices;
  HWY_ALIGN std::uint32_t at[ShownSamples::kLanes];
  hn::Store(hn::BitCast(indices, hn::Add(hn::Mul(y.cell, hn::Set(integers, plane.width)), x.cell)), indices,
            at);
  const float* above = plane.samples.data();
  return between(between_pairs(Lanes(), above, at, x.share),
                 between_pairs(Lanes(), above + plane.width, at, x.share), y.share);
}

HWY_INLINE Values lit(const TriangleLight& light, Values row, Values first, Values step, Values sample) {
  const Values gain = at_first(light.gain, row, first), offset = along(light.offset, row, first, step);
  sample = hn::Add(hn::Add(sample, hn::Mul(gain, hn::Sub(sample, constant(128)))), offset);
  sample = hn::Min(hn::Max(sample, constant(0)), constant(255));
  return between(sample, constant(light.interior[0]), constant(light.opacity));
}

void find_differences(const TriangleSource& source, const ReducedPlane& luma, const float* row,
                      const float* first, const float* step, const std::int16_t* shown, std::size_t count,
                      std::int16_t* out) {
  const Lanes lanes;
  const Integers integers;
  const hn::Rebind<std::int16_t, Lanes> halves;
  const TexturePlace place = source.place.value_or(TexturePlace{{0, 1, 0}, {0, 0, 1}});
  for (std::size_t i = 0; i < count; i += hn::Lanes(lanes)) {
    const Values r = hn::LoadU(lanes, row + i), f = hn::LoadU(lanes, first + i),
                 s = hn::LoadU(lanes, step + i);
    const Axis x(along(place.u, r, f, s), source.inset, luma.width),
        y(along(place.v, r, f, s), source.inset, luma.height);
    Values sample = interpolated(luma, x, y);
    if (source.light) sample = lit(*source.light, r, f, s, sample);
    const auto rounded = hn::ConvertTo(integers, hn::Add(sample, constant(0.5F)));
    hn::StoreU(hn::DemoteTo(halves, hn::Sub(rounded, hn::PromoteTo(integers, hn::LoadU(halves, shown + i)))),
               halves, out + i);
  }
}

std::int64_t sum_products(const std::int16_t* a, const std::int16_t* b, std::size_t count) {
  std::int64_t out = 0;
  std::size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  constexpr std::size_t kPiece = 4096;  // products of errors stay within 32 bits
  const hn::CappedTag<std::int16_t, 32> lanes;
  const hn::RepartitionToWide<decltype(lanes)> wide;
  while (count - i >= hn::Lanes(lanes)) {
    auto even = hn::Zero(wide), odd = even;
    for (const std::size_t end = std::min(i + kPiece, count); end - i >= hn::Lanes(lanes);
         i += hn::Lanes(lanes))
      even = hn::ReorderWidenMulAccumulate(wide, hn::LoadU(lanes, a + i), hn::LoadU(lanes, b + i), even, odd);
    out += hn::GetLane(hn::SumOfLanes(wide, hn::Add(even, odd)));
  }
#endif
  for (; i < count; ++i) out += a[i] * b[i];
  return out;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace fbs
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fbs {

HWY_EXPORT(find_differences);
HWY_EXPORT(sum_products);

void ShownSamples::add(const SurfaceRun& run, const ReducedPlane& shown) {
  const float* from = shown.row(run.row) + run.first;
  for (int i = 0; i < run.count; ++i, ++size_) {
    row_[size_] = static_cast<float>(run.row);
    first_[size_] = static_cast<float>(run.first);
    step_[size_] = static_cast<float>(i);
    luma_[size_] = static_cast<std::int16_t>(rounded(from[i]));
  }
}

void ShownSamples::differences(const TriangleSource& source, const ReducedPlane& luma, std::size_t begin,
                               std::size_t end, std::int16_t* out) const {
  FBS_DISPATCH(find_differences, HWY_STATIC_DISPATCH(find_differences))
  (source, luma, &row_[begin], &first_[begin], &step_[begin], &luma_[begin], end - begin, out);
}

std::int64_t error_product(std::span<const std::int16_t> a, std::span<const std::int16_t> b) {
  return FBS_DISPATCH(sum_products, HWY_STATIC_DISPATCH(sum_products))(a.data(), b.data(), a.size());
}

}  // namespace fbs
#endif
