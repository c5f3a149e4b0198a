// Rows of eight samples of U and V as one row of sixteen, in one vector or two. Compiled for each kind of
// processor, like Highway's own headers of this name.
#if defined(FBS_DECODER_VECTORS_TWO_PLANES_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FBS_DECODER_VECTORS_TWO_PLANES_H_
#undef FBS_DECODER_VECTORS_TWO_PLANES_H_
#else
#define FBS_DECODER_VECTORS_TWO_PLANES_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace fbs {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

/// Loads samples of the common row.
/// @param d     of 8 or 16 lanes
/// @param x     first sample, 0 or 8
/// @param u, v  eight samples each
template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<hwy::HWY_NAMESPACE::Rebind<std::uint8_t, D>> load_two(
    D d, std::size_t x, const std::uint8_t* u, const std::uint8_t* v) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::Rebind<std::uint8_t, D> bytes;
  (void)d;
  if constexpr (hn::MaxLanes(D()) == 16) {
    const hn::Half<decltype(bytes)> half;
    return hn::Combine(bytes, hn::LoadU(half, v), hn::LoadU(half, u));
  } else {
    return hn::LoadU(bytes, x == 0 ? u : v);
  }
}

/// Stores samples of the common row.
template <class D, class Bytes>
HWY_INLINE void store_two(D d, std::size_t x, Bytes samples, std::uint8_t* u, std::uint8_t* v) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::Rebind<std::uint8_t, D> bytes;
  (void)d;
  if constexpr (hn::MaxLanes(D()) == 16) {
    const hn::Half<decltype(bytes)> half;
    hn::StoreU(hn::LowerHalf(half, samples), half, u);
    hn::StoreU(hn::UpperHalf(half, samples), half, v);
  } else {
    hn::StoreU(samples, bytes, x == 0 ? u : v);
  }
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace fbs
HWY_AFTER_NAMESPACE();

#endif
