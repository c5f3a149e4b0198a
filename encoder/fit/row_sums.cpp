#include "encoder/fit/row_sums.h"

#include "decoder/vectors/fixed_vectors.h"
#include "decoder/vectors/scalar.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "encoder/fit/row_sums.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each kind of processor
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace fbs {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, kRowLanes>;

/// Products of kRowsTogether rows, added up, of one row of the result.
HWY_INLINE hn::Vec<Lanes> products(const float* weighted, std::size_t stride, hn::Vec<Lanes> a,
                                   hn::Vec<Lanes> b, hn::Vec<Lanes> c, hn::Vec<Lanes> d) {
  const Lanes lanes;
  auto sum = hn::Mul(hn::Set(lanes, weighted[0]), a);
  sum = hn::Add(sum, hn::Mul(hn::Set(lanes, weighted[stride]), b));
  sum = hn::Add(sum, hn::Mul(hn::Set(lanes, weighted[2 * stride]), c));
  return hn::Add(sum, hn::Mul(hn::Set(lanes, weighted[3 * stride]), d));
}

void sums(const float* rows, const float* weighted, std::size_t count, std::size_t stride, float* out) {
  static_assert(kRowsTogether == 4);
  const Lanes lanes;
  for (std::size_t j = 0; j < stride; j += hn::Lanes(lanes))
    for (std::size_t i = 0; i < j + hn::Lanes(lanes); i += 4) {  // four rows of the result at a time
      auto sum0 = hn::Zero(lanes), sum1 = sum0, sum2 = sum0, sum3 = sum0;
      for (std::size_t row = 0; row < count; row += kRowsTogether) {
        const float *at = rows + row * stride + j, *w = weighted + row * stride + i;
        const auto a = hn::LoadU(lanes, at), b = hn::LoadU(lanes, at + stride),
                   c = hn::LoadU(lanes, at + 2 * stride), d = hn::LoadU(lanes, at + 3 * stride);
        sum0 = hn::Add(sum0, products(w, stride, a, b, c, d));
        sum1 = hn::Add(sum1, products(w + 1, stride, a, b, c, d));
        sum2 = hn::Add(sum2, products(w + 2, stride, a, b, c, d));
        sum3 = hn::Add(sum3, products(w + 3, stride, a, b, c, d));
      }
      float* to = out + i * stride + j;
      hn::StoreU(sum0, lanes, to);
      hn::StoreU(sum1, lanes, to + stride);
      hn::StoreU(sum2, lanes, to + 2 * stride);
      hn::StoreU(sum3, lanes, to + 3 * stride);
    }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace fbs
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fbs {
HWY_EXPORT(sums);

void sum_products(const float* rows, const float* weighted, std::size_t count, std::size_t stride,
                  float* out) {
  FBS_DISPATCH(sums, HWY_STATIC_DISPATCH(sums))(rows, weighted, count, stride, out);
}

}  // namespace fbs
#endif
