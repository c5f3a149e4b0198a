#include "decoder/raster/triangle_kernels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "decoder/raster/blend_weights.h"
#include "decoder/raster/triangle_kernels_plain.h"
#include "decoder/vectors/fixed_vectors.h"
#include "decoder/vectors/scalar.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "decoder/raster/triangle_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each kind of processor
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace fbs {
namespace HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_SCALAR

void draw_short(const ShortTriangle& t, PlaneScale scale, std::span<const TextureSource> sources,
                std::span<const PlaneView> target, DepthPlane& depth) {
  plain::draw_short_triangle(t, scale, sources, target, depth);
}

int covered(const DepthPlane& depth, const SampleArea& part) {
  return plain::count_covered(depth, part);
}

#else

namespace hn = hwy::HWY_NAMESPACE;

/// Samples drawn together.
using Wide = hn::CappedTag<std::int32_t, 8>;
using Numbers = hn::Vec<Wide>;
using Short = hn::Rebind<std::int16_t, Wide>;
using Unsigned = hn::Rebind<std::uint16_t, Wide>;
using Bytes = hn::Rebind<std::uint8_t, Wide>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Wide()));

alignas(32) constexpr std::int32_t kNumbers[8] = {0, 1, 2, 3, 4, 5, 6, 7};

/// Some samples of a row.
struct Step {
  int row, column;  ///< of the target
  int count;        ///< drawn samples, 1..kLanes
};

/// A quantity at the beginning of rows.
struct RowStart {
  std::int32_t value, dx, dy;
  explicit RowStart(const ShortGradient& g) : value(g.first), dx(g.dx), dy(g.dy) {}
  /// @param x  samples from the beginning
  [[nodiscard]] std::int32_t at(int x) const { return value + x * dx; }
  HWY_INLINE Numbers lanes(int x, Numbers number) const {
    const Wide d;
    return hn::Add(hn::Set(d, at(x)), hn::Mul(number, hn::Set(d, dx)));
  }
  void step() { value += dy; }
};

/// All quantities at the beginning of a row.
struct RowStarts {
  RowStart u, v, depth, offset, gain;
  std::array<RowStart, kMaxShortSources - 1> weight;
  explicit RowStarts(const ShortTriangle& t)
      : u(t.u),
        v(t.v),
        depth(t.depth),
        offset(t.offset),
        gain(t.gain),
        weight{RowStart(t.weight[0]), RowStart(t.weight[1])} {}
  void step() {
    u.step();
    v.step();
    depth.step();
    offset.step();
    gain.step();
    for (RowStart& w : weight) w.step();
  }
};

/// Positions of a step's samples in a texture.
struct Places {
  const std::int32_t column, row;  ///< the least
  hn::Vec<Short> columns, rows;    ///< relative to it
  hn::Vec<Unsigned> right, down;   ///< fractions, 1/256
};

HWY_INLINE Places places_of(const RowStarts& start, int x, int count, Numbers number) {
  const Wide d;
  const Short s;
  const Numbers u = start.u.lanes(x, number), v = start.v.lanes(x, number);
  const std::int32_t column = (start.u.dx >= 0 ? start.u.at(x) : start.u.at(x + count - 1)) >> 16,
                     row = (start.v.dx >= 0 ? start.v.at(x) : start.v.at(x + count - 1)) >> 16;
  const auto fraction = [&](Numbers place) HWY_ATTR {
    return hn::BitCast(Unsigned(), hn::DemoteTo(s, hn::And(hn::ShiftRight<8>(place), hn::Set(d, 255))));
  };
  return {column,
          row,
          hn::DemoteTo(s, hn::Sub(hn::ShiftRight<16>(u), hn::Set(d, column))),
          hn::DemoteTo(s, hn::Sub(hn::ShiftRight<16>(v), hn::Set(d, row))),
          fraction(u),
          fraction(v)};
}

/// Two neighbours of each sample, the left one in the low byte.
struct Pairs {
  hn::Vec<Unsigned> top, bottom;
};

/// Looks up bytes in a few rows.
/// @param kSpan  rows that the positions lie in, less one
template <int kSpan>
HWY_INLINE Pairs pairs_by_table(const ConstPlaneView& texture, const Places& at) {
  const Short s;
  const Unsigned u;
  const hn::FixedTag<std::uint8_t, 16> table;
  const hn::Repartition<std::uint8_t, Short> places;
  const auto pair =
      hn::BitCast(places, hn::Add(hn::Or(at.columns, hn::ShiftLeft<8>(at.columns)), hn::Set(s, 256)));
  const std::uint8_t* const first = texture.data + at.row * texture.stride + at.column;
  const auto look_up = [&](int below) HWY_ATTR {
    return hn::BitCast(u, hn::TableLookupBytes(hn::LoadU(table, first + below * texture.stride), pair));
  };
  auto top = look_up(0), bottom = look_up(1);
  auto above = bottom;
  for (int k = 1; k <= kSpan; ++k) {
    const auto is_below = hn::RebindMask(u, hn::Gt(at.rows, hn::Set(s, static_cast<std::int16_t>(k - 1))));
    const auto under = look_up(k + 1);
    top = hn::IfThenElse(is_below, above, top);
    bottom = hn::IfThenElse(is_below, under, bottom);
    above = under;
  }
  return {top, bottom};
}

/// Loads pairs one by one. (Gathers take longer: x86 processors since 2023 make them slow on purpose.)
HWY_INLINE Pairs pairs_one_by_one(const ConstPlaneView& texture, const Places& at) {
  const Wide d;
  alignas(32) std::int32_t offset[8];
  const Numbers rows =
      hn::Mul(hn::PromoteTo(d, at.rows), hn::Set(d, static_cast<std::int32_t>(texture.stride)));
  hn::Store(hn::Add(rows, hn::PromoteTo(d, at.columns)), d, offset);
  const std::uint8_t* const first = texture.data + at.row * texture.stride + at.column;
  const auto load = [&](const std::uint8_t* from, int k) {
    std::uint16_t pair = 0;
    std::memcpy(&pair, from + offset[k], sizeof pair);
    return std::endian::native == std::endian::little ? pair
                                                      : static_cast<std::uint16_t>(pair << 8 | pair >> 8);
  };
  const auto load_all = [&](const std::uint8_t* from) HWY_ATTR {
    auto pairs = hn::Set(Unsigned(), load(from, 0));
    pairs = hn::InsertLane(pairs, 1, load(from, 1));
    pairs = hn::InsertLane(pairs, 2, load(from, 2));
    pairs = hn::InsertLane(pairs, 3, load(from, 3));
    if constexpr (kLanes == 8) {
      pairs = hn::InsertLane(pairs, 4, load(from, 4));
      pairs = hn::InsertLane(pairs, 5, load(from, 5));
      pairs = hn::InsertLane(pairs, 6, load(from, 6));
      pairs = hn::InsertLane(pairs, 7, load(from, 7));
    }
    return pairs;
  };
  return {load_all(first), load_all(first + texture.stride)};
}

HWY_INLINE hn::Vec<Unsigned> bilinear(const Pairs& pairs, const Places& at) {
  const Unsigned u;
  const auto left = hn::Sub(hn::Set(u, 256), at.right), share = hn::ShiftLeft<8>(at.down);
  const auto across = [&](hn::Vec<Unsigned> pair) HWY_ATTR {
    return hn::Add(hn::Mul(hn::And(pair, hn::Set(u, 255)), left), hn::Mul(hn::ShiftRight<8>(pair), at.right));
  };
  const auto top = across(pairs.top), bottom = across(pairs.bottom);
  // (bottom - top) times the lower share, modulo 2^16: where top is larger, the difference has 2^16 too much.
  const auto too_much = hn::IfThenElseZero(hn::Lt(bottom, top), share);
  const auto more = hn::Sub(hn::MulHigh(hn::Sub(bottom, top), share), too_much);
  return hn::ShiftRight<8>(hn::Add(hn::Add(top, more), hn::Set(u, 128)));
}

/// light_row()
HWY_INLINE hn::Vec<Unsigned> lit(hn::Vec<Unsigned> luma, const RowStarts& start, int x, Numbers number) {
  const Wide d;
  const Numbers before = hn::PromoteTo(d, luma);
  const Numbers offset = hn::ShiftRight<8>(start.offset.lanes(x, number)),
                gain = hn::ShiftRight<8>(start.gain.lanes(x, number));
  const Numbers by_gain = hn::ShiftRight<6>(hn::Mul(hn::Sub(before, hn::Set(d, 128)), gain));
  const Numbers sum =
      hn::Add(hn::Add(hn::ShiftLeft<12>(before), offset), hn::Add(by_gain, hn::Set(d, 1 << 11)));
  const Numbers after = hn::Min(hn::Max(hn::ShiftRight<12>(sum), hn::Zero(d)), hn::Set(d, 255));
  return hn::BitCast(Unsigned(), hn::DemoteTo(Short(), after));
}

/// Which samples of a step are drawn: those nearer than the depth recorded, which is updated.
/// @param any  whether there are any
/// @return 255 for each, otherwise 0
HWY_INLINE hn::Vec<Bytes> nearer(std::int32_t* depth, const RowStarts& start, int x, int count,
                                 Numbers number, bool& any) {
  const Wide d;
  const Numbers here = start.depth.lanes(x, number), there = hn::LoadU(d, depth);
  const auto is_nearer = hn::And(hn::Lt(here, there), hn::Lt(hn::Load(d, kNumbers), hn::Set(d, count)));
  any = !hn::AllFalse(d, is_nearer);
  hn::StoreU(hn::IfThenElse(is_nearer, here, there), d, depth);
  const hn::Rebind<std::int8_t, Wide> narrow;
  return hn::BitCast(Bytes(), hn::DemoteTo(narrow, hn::VecFromMask(d, is_nearer)));
}

/// Samples of a plane in place; zero beyond its last column.
HWY_INLINE Numbers in_place(const ConstPlaneView& plane, const Step& step) {
  const Wide d;
  const Bytes b;
  const std::uint8_t* const from = plane.row(step.row) + step.column;
  if (step.column + kLanes <= plane.width) return hn::PromoteTo(d, hn::LoadU(b, from));
  std::uint8_t memory[8] = {};
  std::copy_n(from, step.count, memory);
  return hn::PromoteTo(d, hn::LoadU(b, memory));
}

/// Blends the texture with the other sources.
HWY_INLINE hn::Vec<Unsigned> blended(hn::Vec<Unsigned> texture, std::span<const TextureSource> sources,
                                     std::size_t plane, const RowStarts& start, int x, Numbers number,
                                     const Step& step) {
  const Wide d;
  Numbers left = hn::Set(d, kWeightOne), sum = hn::Set(d, kWeightOne / 2), sample = hn::PromoteTo(d, texture);
  for (std::size_t k = 0; k + 1 < sources.size(); ++k) {
    const Numbers linear = hn::ShiftRight<kGradientOneLog2>(start.weight[k].lanes(x, number)),
                  weight = hn::Min(hn::Max(linear, hn::Zero(d)), left);
    left = hn::Sub(left, weight);
    sum = hn::Add(sum, hn::Mul(weight, sample));
    sample = in_place(sources[k + 1].planes[plane], step);
  }
  sum = hn::ShiftRight<kWeightOneLog2>(hn::Add(sum, hn::Mul(left, sample)));
  return hn::BitCast(Unsigned(), hn::DemoteTo(Short(), sum));
}

HWY_INLINE void store(hn::Vec<Unsigned> samples, hn::Vec<Bytes> drawn, const PlaneView& plane,
                      const Step& step) {
  const Bytes b;
  std::uint8_t* const out = plane.row(step.row) + step.column;
  const auto bytes = hn::DemoteTo(b, hn::BitCast(Short(), samples));
  const auto mixed = [&](hn::Vec<Bytes> before)
                         HWY_ATTR { return hn::Or(hn::And(bytes, drawn), hn::AndNot(drawn, before)); };
  if (step.column + kLanes <= plane.width) {
    hn::StoreU(mixed(hn::LoadU(b, out)), b, out);
  } else {
    std::uint8_t memory[8] = {};
    std::copy_n(out, step.count, memory);
    hn::StoreU(mixed(hn::LoadU(b, memory)), b, memory);
    std::copy_n(memory, step.count, out);
  }
}

/// How a triangle's samples are looked up: in a table of this many rows and one more, or one by one.
enum Lookup : int { kOneByOne = -1, kTwoRows = 1, kFourRows = 3 };

template <int kLookup>
HWY_INLINE Pairs pairs_of(const ConstPlaneView& texture, const Places& at) {
  if constexpr (kLookup == kOneByOne)
    return pairs_one_by_one(texture, at);
  else
    return pairs_by_table<kLookup>(texture, at);
}

template <PlaneScale kScale, int kLookup>
HWY_INLINE void draw_step(const RowStarts& start, int x, const Step& step, bool has_light,
                          std::span<const TextureSource> sources, std::span<const PlaneView> target,
                          DepthPlane& depth) {
  const Wide d;
  const Numbers number = hn::Min(hn::Load(d, kNumbers), hn::Set(d, step.count - 1));
  bool any = false;
  const auto drawn = nearer(depth.row(step.row) + step.column, start, x, step.count, number, any);
  if (!any) return;
  const Places at = places_of(start, x, step.count, number);
  for (std::size_t k = 0; k < (kScale == PlaneScale::kLuma ? 1 : 2); ++k) {
    const Pairs pairs = pairs_of<kLookup>(sources[0].planes[k], at);
    auto samples = bilinear(pairs, at);
    if (kScale == PlaneScale::kLuma && has_light) samples = lit(samples, start, x, number);
    if (sources.size() > 1) samples = blended(samples, sources, k, start, x, number, step);
    store(samples, drawn, target[k], step);
  }
}

template <PlaneScale kScale, int kLookup>
void draw_rows(const ShortTriangle& t, std::span<const TextureSource> sources,
               std::span<const PlaneView> target, DepthPlane& depth) {
  RunWalker runs = t.runs;
  RowStarts start(t);
  for (int row = t.box.y0; row < t.box.y1; ++row, start.step()) {
    const RowRun run = runs.next();
    for (int column = run.first; column <= run.last; column += kLanes)
      draw_step<kScale, kLookup>(start, column - t.box.x0,
                                 {row, column, std::min(run.last - column + 1, kLanes)}, t.has_light, sources,
                                 target, depth);
  }
}

/// Whether the positions of a step are close enough for a lookup.
bool fits(std::int32_t per_sample, int columns) {
  return std::abs(std::int64_t{per_sample}) * (kLanes - 1) <= std::int64_t{columns} << 16;
}

template <PlaneScale kScale>
void draw_scale(const ShortTriangle& t, std::span<const TextureSource> sources,
                std::span<const PlaneView> target, DepthPlane& depth) {
  constexpr int kMostColumns = kReadColumns - 3;  // minus one that fractions add, and the right neighbour
  if (fits(t.u.dx, kMostColumns) && fits(t.v.dx, kTwoRows))
    draw_rows<kScale, kTwoRows>(t, sources, target, depth);
  else if (fits(t.u.dx, kMostColumns) && fits(t.v.dx, kFourRows))
    draw_rows<kScale, kFourRows>(t, sources, target, depth);
  else
    draw_rows<kScale, kOneByOne>(t, sources, target, depth);
}

void draw_short(const ShortTriangle& t, PlaneScale scale, std::span<const TextureSource> sources,
                std::span<const PlaneView> target, DepthPlane& depth) {
  if (scale == PlaneScale::kLuma)
    draw_scale<PlaneScale::kLuma>(t, sources, target, depth);
  else
    draw_scale<PlaneScale::kChroma>(t, sources, target, depth);
}

int covered(const DepthPlane& depth, const SampleArea& part) {
  const Wide d;
  const Numbers nothing = hn::Set(d, kNothingDrawn);
  Numbers uncovered = hn::Zero(d);  // -1 for each sample
  for (int y = part.y0; y < part.y1; ++y)
    for (int x = part.x0; x < part.x1; x += kLanes) {
      const auto is_part = hn::Lt(hn::Load(d, kNumbers), hn::Set(d, part.x1 - x));
      const auto is_nothing = hn::Eq(hn::LoadU(d, depth.row(y) + x), nothing);
      uncovered = hn::Add(uncovered, hn::VecFromMask(d, hn::And(is_part, is_nothing)));
    }
  return part.count() + hn::GetLane(hn::SumOfLanes(d, uncovered));
}

#endif

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace fbs
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fbs {

HWY_EXPORT(draw_short);
HWY_EXPORT(covered);

void draw_short_triangle(const ShortTriangle& triangle, PlaneScale scale,
                         std::span<const TextureSource> sources, std::span<const PlaneView> target,
                         DepthPlane& depth) {
  FBS_DISPATCH(draw_short, plain::draw_short_triangle)(triangle, scale, sources, target, depth);
}

int count_covered(const DepthPlane& depth, const SampleArea& part) {
  return FBS_DISPATCH(covered, plain::count_covered)(depth, part);
}

}  // namespace fbs
#endif
