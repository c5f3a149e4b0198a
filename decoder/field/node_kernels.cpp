#include "decoder/field/node_kernels.h"

#include <algorithm>

#include "decoder/field/node_kernels_plain.h"
#include "decoder/field/node_weights.h"
#include "decoder/vectors/fixed_vectors.h"
#include "decoder/vectors/scalar.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "decoder/field/node_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each kind of processor
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace fbs {
namespace HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_SCALAR

void weigh(std::span<const NodePlace> places, const std::int32_t* corners, const std::uint16_t* outside,
           std::size_t row, int step_log2, std::uint16_t* out) {
  plain::weigh_nodes(places, corners, outside, row, step_log2, out);
}
void displace(const NodeCover& cover, const std::int32_t* moved, const NodeLimits& limits, std::size_t row,
              std::int32_t* out) {
  plain::displace_nodes(cover, moved, limits, row, out);
}
void motions(const BlockNodes& nodes, std::size_t first, BlockMotions& out) {
  plain::find_motions(nodes, first, out);
}

#else

namespace hn = hwy::HWY_NAMESPACE;

/// Some sources of a row.
using Sources = hn::CappedTag<std::int32_t, kRowStep>;
using Values = hn::Vec<Sources>;

/// NodePlace::mean() for small numbers.
class Mean {
 public:
  /// @param rows  of the points  @param size  of a row
  HWY_INLINE Mean(const NodePlace& place, const std::int32_t* rows, std::size_t size)
      : a_(rows + static_cast<std::size_t>(place.corner[0]) * size),
        b_(rows + static_cast<std::size_t>(place.corner[1]) * size),
        c_(rows + static_cast<std::size_t>(place.corner[2]) * size),
        place_(place) {}
  HWY_INLINE Values at(std::size_t s) const {
    const Sources d;
    const Values a = hn::LoadU(d, a_ + s), half = hn::Set(d, 1 << (kCornerShareOneLog2 - 1));
    const Values more = hn::Add(hn::Mul(hn::Sub(hn::LoadU(d, b_ + s), a), hn::Set(d, place_.share[0])),
                                hn::Mul(hn::Sub(hn::LoadU(d, c_ + s), a), hn::Set(d, place_.share[1])));
    return hn::Add(a, hn::ShiftRight<kCornerShareOneLog2>(hn::Add(more, half)));
  }

 private:
  const std::int32_t *a_, *b_, *c_;
  const NodePlace& place_;
};

void weigh(std::span<const NodePlace> places, const std::int32_t* corners, const std::uint16_t* outside,
           std::size_t row, int step_log2, std::uint16_t* out) {
  constexpr int kToNodeLog2 = 4;
  static_assert(kMeshWeightOne == kNodeWeightOne << kToNodeLog2);
  const Sources d;
  const hn::Rebind<std::uint16_t, Sources> narrow;
  const int bits = kToNodeLog2 + step_log2;
  const auto rounded = [&](auto sum)
                           HWY_ATTR { return hn::ShiftLeftSame(hn::ShiftRightSame(sum, bits), step_log2); };
  for (const NodePlace& place : places) {
    if (place.is_covered()) {
      const Mean mean(place, corners, row);
      auto before = static_cast<std::uint16_t>(1 << (bits - 1));  // sum of the weights, and half a step
      for (std::size_t s = 0; s < row; s += hn::Lanes(d)) {
        const auto weight = hn::DemoteTo(narrow, mean.at(s));
        auto sum = hn::Add(weight, hn::ShiftLeftLanes<1>(narrow, weight));
        sum = hn::Add(sum, hn::ShiftLeftLanes<2>(narrow, sum));
        if constexpr (hn::MaxLanes(Sources()) > 4) sum = hn::Add(sum, hn::ShiftLeftLanes<4>(narrow, sum));
        sum = hn::Add(sum, hn::Set(narrow, before));
        hn::StoreU(hn::Sub(rounded(sum), rounded(hn::Sub(sum, weight))), narrow, out + s);
        before = hn::ExtractLane(sum, hn::Lanes(d) - 1);
      }
    } else {
      std::copy_n(outside, row, out);
    }
    out += row;
  }
}

void displace(const NodeCover& cover, const std::int32_t* moved, const NodeLimits& limits, std::size_t row,
              std::int32_t* out) {
  const Sources d;
  const NodePlace* place = cover.places().data();
  for (int j = 0; j < cover.grid().rows(); ++j) {
    for (int i = 0; i < cover.grid().columns(); ++i, ++place, out += 2 * row) {
      if (!place->is_covered()) {
        std::fill_n(out, 2 * row, 0);
        continue;
      }
      const Mean mean(*place, moved, 2 * row);
      const auto bring = [&](std::size_t begin, std::int32_t node, std::int32_t first, std::int32_t last)
                             HWY_ATTR {
                               const Values low = hn::Set(d, first - node), high = hn::Set(d, last - node);
                               for (std::size_t s = begin; s < begin + row; s += hn::Lanes(d))
                                 hn::StoreU(hn::Min(hn::Max(mean.at(s), low), high), d, out + s);
                             };
      bring(0, NodeGrid::place(i), limits.first.x, limits.last.x);
      bring(row, NodeGrid::place(j), limits.first.y, limits.last.y);
    }
  }
}

/// Finds the kind of a square of patches, by its nodes, and the mean of its corners, for hn::Lanes(Sources)
/// sources from place s of the rows on, at place `to` of the result.
/// @param kSize  patches in a row of the square
/// @return the largest difference of displacements
template <int kSize>
HWY_INLINE Values find_square(const BlockNodes& nodes, int column, int line, std::size_t s, std::size_t to,
                              BlockMotions::Row& kind, BlockMotions::RowOfBoth& by) {
  const Sources d;
  Values any = hn::Zero(d), range = any;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto at = [&](int i, int j) HWY_ATTR {
      return hn::LoadU(d, nodes.displacement_at(column + i, line + j) + axis * nodes.row + s);
    };
    Values low = at(0, 0), high = low;
    for (int k = 1; k < (kSize + 1) * (kSize + 1); ++k) {
      const Values displacement = at(k % (kSize + 1), k / (kSize + 1));
      low = hn::Min(low, displacement);
      high = hn::Max(high, displacement);
    }
    any = hn::Or(any, hn::Or(low, high));
    range = hn::Max(range, hn::Sub(high, low));
    const Values sum = hn::Add(hn::Add(at(0, 0), at(kSize, 0)), hn::Add(at(0, kSize), at(kSize, kSize)));
    hn::StoreU(hn::ShiftRight<2>(hn::Add(sum, hn::Set(d, 2))), d, by[axis].data() + to);
  }
  const Values moved =
      hn::IfThenElse(hn::Gt(range, hn::Set(d, kEvenEnough)), hn::Set(d, kBent), hn::Set(d, kEven));
  hn::StoreU(hn::IfThenElse(hn::Eq(any, hn::Zero(d)), hn::Set(d, kStill), moved), d, kind.data() + to);
  return range;
}

/// Finds the motions of hn::Lanes(Sources) sources from place s of the rows on, at place `to` of the result.
HWY_INLINE void find_some(const BlockNodes& nodes, std::size_t s, std::size_t to, BlockMotions& out) {
  const Sources d;
  const Values range = find_square<2>(nodes, 0, 0, s, to, out.whole, out.whole_by);
  if (hn::AllFalse(d, hn::Gt(range, hn::Set(d, kEvenEnough)))) return;
  for (int patch = 0; patch < 4; ++patch)
    find_square<1>(nodes, patch % 2, patch / 2, s, to, out.kind[patch], out.by[patch]);
}

void motions(const BlockNodes& nodes, std::size_t first, BlockMotions& out) {
  const hn::CappedTag<std::uint16_t, kRowStep> d;
  static_assert(hn::MaxLanes(hn::CappedTag<std::uint16_t, kRowStep>()) == kRowStep);
  const auto row = [&](int j) HWY_ATTR {
    return hn::Or(
        hn::LoadU(d, nodes.weight_at(0, j) + first),
        hn::Or(hn::LoadU(d, nodes.weight_at(1, j) + first), hn::LoadU(d, nodes.weight_at(2, j) + first)));
  };
  const auto weight = hn::Or(row(0), hn::Or(row(1), row(2)));
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, hn::Ne(weight, hn::Zero(d)), bits);
  out.shown = bits[0];
  out.whole.fill(kStill);
  if (nodes.displacement == nullptr || out.shown == 0) return;
  const Sources sources;
  for (std::size_t s = 0; s < kRowStep; s += hn::Lanes(sources)) find_some(nodes, first + s, s, out);
}

#endif

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace fbs
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fbs {

HWY_EXPORT(weigh);
HWY_EXPORT(displace);
HWY_EXPORT(motions);

void weigh_nodes(std::span<const NodePlace> places, const std::int32_t* corners, const std::uint16_t* outside,
                 std::size_t row, int step_log2, std::uint16_t* out) {
  FBS_DISPATCH(weigh, plain::weigh_nodes)(places, corners, outside, row, step_log2, out);
}

void displace_nodes(const NodeCover& cover, const std::int32_t* moved, const NodeLimits& limits,
                    std::size_t row, std::int32_t* out) {
  FBS_DISPATCH(displace, plain::displace_nodes)(cover, moved, limits, row, out);
}

void find_motions(const BlockNodes& nodes, std::size_t first, BlockMotions& out) {
  FBS_DISPATCH(motions, plain::find_motions)(nodes, first, out);
}

}  // namespace fbs
#endif
