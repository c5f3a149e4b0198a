#include "decoder/field/warp_kernels.h"

#include <algorithm>

#include "decoder/field/warp_kernels_plain.h"
#include "decoder/vectors/fixed_vectors.h"
#include "decoder/vectors/scalar.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "decoder/field/warp_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each kind of processor
#include <hwy/highway.h>

#include "decoder/vectors/two_planes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fbs {
namespace HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_SCALAR

void even_luma(const std::uint8_t* from, std::ptrdiff_t stride, glm::ivec2 fraction, int size,
               std::uint8_t* out) {
  plain::warp_even_luma(from, stride, fraction, size, out);
}
void even_chroma(const ChromaSamples& from, std::ptrdiff_t stride, glm::ivec2 fraction, int size,
                 const ChromaOut& out) {
  plain::warp_even_chroma(from, stride, fraction, size, out);
}
void bent_luma(const std::uint8_t* from, std::ptrdiff_t stride, const PatchNodes& nodes, std::uint8_t* out) {
  plain::warp_bent_luma(from, stride, nodes, out);
}
void bent_chroma(const ChromaSamples& from, std::ptrdiff_t stride, const PatchNodes& nodes,
                 const ChromaOut& out) {
  plain::warp_bent_chroma(from, stride, nodes, out);
}

#else

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kOne = 1 << kFractionOneLog2;
constexpr int kPatchSizeLog2 = 3;
static_assert(kPatchSize == 1 << kPatchSizeLog2);

/// Interpolates between upper and lower samples, each already interpolated from left to right.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V between(D d, V top, V bottom, V fraction) {
  // Difference times fraction, 1/64, rounded to nearest: Q15 of a product with 2^9.
  const V more = hn::MulFixedPoint15(hn::Sub(bottom, top), hn::ShiftLeft<15 - kFractionOneLog2>(fraction));
  return hn::ShiftRight<kFractionOneLog2>(hn::Add(hn::Add(top, more), hn::Set(d, kOne / 2)));
}

/// @param load   loads a row; 0 or 1 is added to the columns
/// @param store  stores samples of a row, given its number
template <class D, class Load, class Store>
HWY_INLINE void even_columns(D d, glm::ivec2 fraction, int rows, Load&& load, Store&& store) {
  using V = hn::Vec<D>;
  const hn::Rebind<std::uint8_t, D> bytes;
  const V right = hn::Set(d, static_cast<std::int16_t>(fraction.x)),
          left = hn::Set(d, static_cast<std::int16_t>(kOne - fraction.x)),
          down = hn::Set(d, static_cast<std::int16_t>(fraction.y));
  const auto across = [&](int row) HWY_ATTR {
    return hn::Add(hn::Mul(hn::PromoteTo(d, load(row, 0)), left),
                   hn::Mul(hn::PromoteTo(d, load(row, 1)), right));
  };
  V top = across(0);
  for (int y = 0; y < rows; ++y) {
    const V bottom = across(y + 1);
    store(hn::DemoteTo(bytes, between(d, top, bottom, down)), y);
    top = bottom;
  }
}

template <class D>
HWY_INLINE void even_luma_columns(D d, const std::uint8_t* from, std::ptrdiff_t stride, glm::ivec2 fraction,
                                  int size, std::uint8_t* out) {
  const hn::Rebind<std::uint8_t, D> bytes;
  for (int x = 0; x < size; x += static_cast<int>(hn::Lanes(d)))
    even_columns(
        d, fraction, size,
        [&](int row, int right) HWY_ATTR { return hn::LoadU(bytes, from + row * stride + x + right); },
        [&](auto samples, int row)
            HWY_ATTR { hn::StoreU(samples, bytes, out + row * WarpedBlock::kStride + x); });
}

void even_luma(const std::uint8_t* from, std::ptrdiff_t stride, glm::ivec2 fraction, int size,
               std::uint8_t* out) {
  const hn::CappedTag<std::int16_t, kBlockSize> whole;
  const hn::CappedTag<std::int16_t, kPatchSize> half;
  if (hn::Lanes(whole) > hn::Lanes(half) && size == kBlockSize)
    even_luma_columns(whole, from, stride, fraction, size, out);
  else
    even_luma_columns(half, from, stride, fraction, size, out);
}

void even_chroma(const ChromaSamples& from, std::ptrdiff_t stride, glm::ivec2 fraction, int size,
                 const ChromaOut& out) {
  const hn::CappedTag<std::int16_t, 16> d;
  for (std::size_t x = 0; x < 16; x += hn::Lanes(d))
    even_columns(
        d, fraction, size,
        [&](int row, int right) HWY_ATTR {
          const std::ptrdiff_t at = row * stride + right;
          return load_two(d, x, from[0] + at, from[1] + at);
        },
        [&](auto samples, int row) HWY_ATTR {
          const std::ptrdiff_t at = row * WarpedBlock::kStride;
          store_two(d, x, samples, out[0] + at, out[1] + at);
        });
}

// A bent patch is drawn in vectors of one or two rows of luma; for chroma, of two rows of one plane or of
// both. The samples of a vector come from a few rows of the texture, whose bytes are looked up in tables.

/// Positions of a vector's samples in a patch.
struct PatchLanes {
  alignas(32) std::int16_t column[16], row[16];  ///< luma samples
  alignas(32) std::int16_t place[16];            ///< 64 for each sample from the patch's first column
  alignas(32) std::int16_t table[16];            ///< where the bytes of the lane's row begin
};
constexpr PatchLanes kLumaLanes = {{0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7},
                                   {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1},
                                   {0, 64, 128, 192, 256, 320, 384, 448, 0, 64, 128, 192, 256, 320, 384, 448},
                                   {}};
constexpr PatchLanes kChromaLanes = {{0, 2, 4, 6, 0, 2, 4, 6, 0, 2, 4, 6, 0, 2, 4, 6},
                                     {0, 0, 0, 0, 2, 2, 2, 2, 0, 0, 0, 0, 2, 2, 2, 2},
                                     {0, 64, 128, 192, 0, 64, 128, 192, 0, 64, 128, 192, 0, 64, 128, 192},
                                     {0, 0, 0, 0, 8, 8, 8, 8, 0, 0, 0, 0, 8, 8, 8, 8}};

/// One coordinate of a patch's displacements, in 16 bits.
struct ShortDisplacement {
  std::int32_t first;       ///< origin, luma samples: a multiple of the plane's sample spacing
  std::int16_t upper_left;  ///< 1/64 luma sample, relative to `first`
  std::int16_t across, down, twist;
  std::int32_t range;  ///< difference of least and largest

  /// @param step_log2  log2 of luma samples per sample
  ShortDisplacement(const PatchNodes& nodes, int glm::ivec2::*axis, int step_log2) {
    const std::int32_t d00 = nodes[0].*axis, d10 = nodes[1].*axis, d01 = nodes[2].*axis, d11 = nodes[3].*axis;
    const auto [least, most] = std::minmax({d00, d10, d01, d11});
    first = least >> (kFractionOneLog2 + step_log2) << step_log2;
    upper_left = static_cast<std::int16_t>(d00 - (first << kFractionOneLog2));
    across = static_cast<std::int16_t>(d10 - d00);
    down = static_cast<std::int16_t>(d01 - d00);
    twist = static_cast<std::int16_t>(d11 - d10 - d01 + d00);
    range = most - least;
  }
};

/// The displacements of a vector's samples, relative to ShortDisplacement::first. Sums are less than 2^15:
/// the range is less than 2^9, and weights sum to 64.
/// @param kStepLog2  log2 of luma samples per sample
template <int kStepLog2, class D>
class Displacements {
 public:
  using V = hn::Vec<D>;
  HWY_INLINE Displacements(D d, const PatchLanes& lanes, std::size_t first_lane, const ShortDisplacement& by,
                           int rows_per_step)
      : d_(d), upper_left_(hn::Set(d, by.upper_left)) {
    const V column = hn::Load(d, lanes.column + first_lane), row = hn::Load(d, lanes.row + first_lane);
    const V per_row =
        hn::Add(hn::ShiftLeft<kPatchSizeLog2>(hn::Set(d, by.down)), hn::Mul(column, hn::Set(d, by.twist)));
    sum_ = hn::Add(
        hn::Add(hn::ShiftLeft<kPatchSizeLog2>(hn::Mul(column, hn::Set(d, by.across))), hn::Mul(row, per_row)),
        hn::Set(d, kOne / 2));
    step_ = hn::Mul(per_row, hn::Set(d, static_cast<std::int16_t>(rows_per_step << kStepLog2)));
  }
  /// Displacements of the next rows, in 1/64 sample of the plane.
  HWY_INLINE V next() {
    const V out = hn::Add(upper_left_, hn::ShiftRight<kFractionOneLog2>(sum_));
    sum_ = hn::Add(sum_, step_);
    return hn::ShiftRight<kStepLog2>(out);
  }

 private:
  D d_;
  V upper_left_, sum_, step_;
};

/// Draws the vectors of a patch, one below the other.
/// @param kSpan  samples of one row come from this many rows of the texture and one more
/// @param load   loads the bytes of the rows from a given one on, in the order of PatchLanes' table
/// @param store  stores the samples of some rows, given the number of the first
template <int kSpan, int kStepLog2, class D, class Load, class Store>
HWY_INLINE void bent_rows(D d, const PatchLanes& lanes, std::size_t first_lane, int rows, int rows_per_step,
                          const ShortDisplacement& by_x, const ShortDisplacement& by_y, Load&& load,
                          Store&& store) {
  using V = hn::Vec<D>;
  const hn::RebindToUnsigned<D> u;
  const hn::Repartition<std::uint8_t, D> table;
  const hn::Rebind<std::uint8_t, D> bytes;
  Displacements<kStepLog2, D> x(d, lanes, first_lane, by_x, rows_per_step),
      y(d, lanes, first_lane, by_y, rows_per_step);
  const V place = hn::Load(d, lanes.place + first_lane), first = hn::Load(d, lanes.table + first_lane),
          mask = hn::Set(d, kOne - 1), one = hn::Set(d, kOne);
  for (int row = 0; row < rows; row += rows_per_step) {
    const V across = hn::Add(place, x.next()), down = y.next();
    // Each lane has the position of its left sample in the low byte, of its right one in the high byte.
    const V left = hn::Add(hn::ShiftRight<kFractionOneLog2>(across), first);
    const auto pair = hn::BitCast(table, hn::Add(hn::Or(left, hn::ShiftLeft<8>(left)), hn::Set(d, 256)));
    const auto look_up = [&](int below) HWY_ATTR {
      return hn::BitCast(u, hn::TableLookupBytes(load(row + below), pair));
    };
    auto top = look_up(0), bottom = look_up(1);
    auto above = bottom;
    for (int k = 1; k <= kSpan; ++k) {
      const auto is_below =
          hn::RebindMask(u, hn::Gt(down, hn::Set(d, static_cast<std::int16_t>(k * kOne - 1))));
      const auto under = look_up(k + 1);
      top = hn::IfThenElse(is_below, above, top);
      bottom = hn::IfThenElse(is_below, under, bottom);
      above = under;
    }
    const V right_share = hn::And(across, mask), left_share = hn::Sub(one, right_share);
    const auto mix = [&](auto both) HWY_ATTR {
      const V low = hn::BitCast(d, hn::And(both, hn::Set(u, 255))),
              high = hn::BitCast(d, hn::ShiftRight<8>(both));
      return hn::Add(hn::Mul(low, left_share), hn::Mul(high, right_share));
    };
    store(hn::DemoteTo(bytes, between(d, mix(top), mix(bottom), hn::And(down, mask))), row);
  }
}

/// A patch whose samples lie too far apart for that: each is gathered by itself.
/// @param kStepLog2  log2 of luma samples per sample
template <int kStepLog2>
HWY_INLINE void gathered_patch(const std::uint8_t* from, std::ptrdiff_t stride, const PatchNodes& nodes,
                               std::uint8_t* out) {
  const hn::CappedTag<std::int32_t, 8> d;
  using V = hn::Vec<decltype(d)>;
  constexpr int kSizeLog2 = kPatchSizeLog2 - kStepLog2, kSize = 1 << kSizeLog2;
  constexpr std::size_t kLanes = hn::MaxLanes(d);
  const auto displacements = [&](int glm::ivec2::*axis, V column, V row) HWY_ATTR {
    const auto set = [&](std::int32_t value) HWY_ATTR { return hn::Set(d, value); };
    const std::int32_t d00 = nodes[0].*axis, d10 = nodes[1].*axis, d01 = nodes[2].*axis, d11 = nodes[3].*axis;
    const V top = hn::Add(set(d00 * kPatchSize), hn::Mul(set(d10 - d00), column)),
            bottom = hn::Add(set(d01 * kPatchSize), hn::Mul(set(d11 - d01), column)),
            sum = hn::Add(hn::ShiftLeft<kPatchSizeLog2>(top), hn::Mul(hn::Sub(bottom, top), row));
    return hn::ShiftRight<kStepLog2>(hn::ShiftRight<kFractionOneLog2>(hn::Add(sum, set(kOne / 2))));
  };
  const V mask = hn::Set(d, kOne - 1), byte = hn::Set(d, 255), one = hn::Set(d, kOne),
          half = hn::Set(d, kOne / 2);
  for (int k = 0; k < kSize * kSize; k += static_cast<int>(kLanes)) {
    const V number = hn::Iota(d, k), column = hn::And(number, hn::Set(d, kSize - 1)),
            row = hn::ShiftRight<kSizeLog2>(number);
    const V x = displacements(&glm::ivec2::x, hn::ShiftLeft<kStepLog2>(column),
                              hn::ShiftLeft<kStepLog2>(row)),
            y = displacements(&glm::ivec2::y, hn::ShiftLeft<kStepLog2>(column),
                              hn::ShiftLeft<kStepLog2>(row));
    const V at = hn::Add(hn::Mul(hn::Add(row, hn::ShiftRight<kFractionOneLog2>(y)),
                                 hn::Set(d, static_cast<std::int32_t>(stride))),
                         hn::Add(column, hn::ShiftRight<kFractionOneLog2>(x)));
    const V right_share = hn::And(x, mask), left_share = hn::Sub(one, right_share);
    const auto across = [&](const std::uint8_t* samples) HWY_ATTR {
      const V four = hn::GatherOffset(d, reinterpret_cast<const std::int32_t*>(samples), at);
      return hn::Add(hn::Mul(hn::And(four, byte), left_share),
                     hn::Mul(hn::And(hn::ShiftRight<8>(four), byte), right_share));
    };
    const V top = across(from), bottom = across(from + stride);
    const V more =
        hn::ShiftRight<kFractionOneLog2>(hn::Add(hn::Mul(hn::Sub(bottom, top), hn::And(y, mask)), half));
    const hn::Rebind<std::uint8_t, decltype(d)> bytes;
    alignas(8) std::array<std::uint8_t, kLanes> drawn;
    hn::Store(hn::DemoteTo(bytes, hn::ShiftRight<kFractionOneLog2>(hn::Add(hn::Add(top, more), half))), bytes,
              drawn.data());
    constexpr std::size_t kRun = std::min<std::size_t>(kLanes, kSize);
    for (std::size_t n = 0; n < kLanes; n += kRun) {
      const std::ptrdiff_t to = (k + static_cast<int>(n)) >> kSizeLog2;
      std::copy_n(drawn.data() + n, kRun, out + to * WarpedBlock::kStride + (k & (kSize - 1)));
    }
  }
}

/// Largest difference of displacements across a patch: the samples of a row must come from sixteen bytes.
constexpr std::int32_t kMaxAcross = 384;

template <int kSpan, class D>
HWY_INLINE void bent_luma_rows(D d, const std::uint8_t* from, std::ptrdiff_t stride,
                               const ShortDisplacement& by_x, const ShortDisplacement& by_y,
                               std::uint8_t* out) {
  const hn::Repartition<std::uint8_t, D> table;
  const hn::FixedTag<std::uint8_t, 16> row_of_table;
  const hn::FixedTag<std::uint8_t, 8> drawn_row;
  constexpr int kRowsPerStep = hn::MaxLanes(D()) / 8;
  from += by_y.first * stride + by_x.first;
  bent_rows<kSpan, 0>(
      d, kLumaLanes, 0, kPatchSize, kRowsPerStep, by_x, by_y,
      [&](int row) HWY_ATTR {
        const std::uint8_t* const at = from + row * stride;
        if constexpr (kRowsPerStep == 2) {
          return hn::Combine(table, hn::LoadU(row_of_table, at + stride), hn::LoadU(row_of_table, at));
        } else {
          return hn::LoadU(row_of_table, at);
        }
      },
      [&](auto samples, int row) HWY_ATTR {
        std::uint8_t* const to = out + row * WarpedBlock::kStride;
        if constexpr (kRowsPerStep == 2) {
          hn::StoreU(hn::LowerHalf(drawn_row, samples), drawn_row, to);
          hn::StoreU(hn::UpperHalf(drawn_row, samples), drawn_row, to + WarpedBlock::kStride);
        } else {
          hn::StoreU(samples, drawn_row, to);
        }
      });
}

void bent_luma(const std::uint8_t* from, std::ptrdiff_t stride, const PatchNodes& nodes, std::uint8_t* out) {
  const hn::CappedTag<std::int16_t, 16> d;
  const ShortDisplacement x(nodes, &glm::ivec2::x, 0), y(nodes, &glm::ivec2::y, 0);
  if (x.range <= kMaxAcross && y.range <= kOne)
    bent_luma_rows<1>(d, from, stride, x, y, out);
  else if (x.range <= kMaxAcross && y.range <= 3 * kOne)
    bent_luma_rows<3>(d, from, stride, x, y, out);
  else
    gathered_patch<0>(from, stride, nodes, out);
}

template <int kSpan, class D>
HWY_INLINE void bent_chroma_rows(D d, const ChromaSamples& from, std::ptrdiff_t stride,
                                 const ShortDisplacement& by_x, const ShortDisplacement& by_y,
                                 const ChromaOut& out) {
  const hn::Repartition<std::uint8_t, D> table;
  const hn::FixedTag<std::uint8_t, 8> row_of_table;
  const hn::FixedTag<std::uint8_t, 16> two_rows;
  const std::ptrdiff_t first = by_y.first / 2 * stride + by_x.first / 2;
  constexpr std::size_t kPlanes = hn::MaxLanes(D()) / 8;
  for (std::size_t plane = 0; plane < 2; plane += kPlanes)
    bent_rows<kSpan, 1>(
        d, kChromaLanes, 0, kPatchSize / 2, 2, by_x, by_y,
        [&](int row) HWY_ATTR {
          const auto two = [&](const std::uint8_t* at) HWY_ATTR {
            at += first + row * stride;
            return hn::Combine(two_rows, hn::LoadU(row_of_table, at + stride), hn::LoadU(row_of_table, at));
          };
          if constexpr (kPlanes == 2)
            return hn::Combine(table, two(from[1]), two(from[0]));
          else
            return two(from[plane]);
        },
        [&](auto samples, int row) HWY_ATTR {
          alignas(16) std::uint8_t drawn[16];
          hn::StoreU(samples, hn::Rebind<std::uint8_t, D>(), drawn);
          for (std::size_t k = 0; k < kPlanes; ++k)
            for (int below = 0; below < 2; ++below)
              std::copy_n(drawn + 8 * k + 4 * below, 4,
                          out[plane + k] + (row + below) * WarpedBlock::kStride);
        });
}

void bent_chroma(const ChromaSamples& from, std::ptrdiff_t stride, const PatchNodes& nodes,
                 const ChromaOut& out) {
  const ShortDisplacement x(nodes, &glm::ivec2::x, 1), y(nodes, &glm::ivec2::y, 1);
  // A halved difference may be rounded up by one half.
  if (x.range < kMaxAcross && y.range < 2 * kOne)
    bent_chroma_rows<1>(hn::CappedTag<std::int16_t, 16>(), from, stride, x, y, out);
  else
    for (std::size_t k = 0; k < 2; ++k) gathered_patch<1>(from[k], stride, nodes, out[k]);
}

#endif

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace fbs
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fbs {

HWY_EXPORT(even_luma);
HWY_EXPORT(even_chroma);
HWY_EXPORT(bent_luma);
HWY_EXPORT(bent_chroma);

void warp_even_luma(const std::uint8_t* from, std::ptrdiff_t stride, glm::ivec2 fraction, int size,
                    std::uint8_t* out) {
  FBS_DISPATCH(even_luma, plain::warp_even_luma)(from, stride, fraction, size, out);
}

void warp_even_chroma(const ChromaSamples& from, std::ptrdiff_t stride, glm::ivec2 fraction, int size,
                      const ChromaOut& out) {
  FBS_DISPATCH(even_chroma, plain::warp_even_chroma)(from, stride, fraction, size, out);
}

void warp_bent_luma(const std::uint8_t* from, std::ptrdiff_t stride, const PatchNodes& nodes,
                    std::uint8_t* out) {
  FBS_DISPATCH(bent_luma, plain::warp_bent_luma)(from, stride, nodes, out);
}

void warp_bent_chroma(const ChromaSamples& from, std::ptrdiff_t stride, const PatchNodes& nodes,
                      const ChromaOut& out) {
  FBS_DISPATCH(bent_chroma, plain::warp_bent_chroma)(from, stride, nodes, out);
}

}  // namespace fbs
#endif
