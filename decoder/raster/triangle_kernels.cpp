#include "decoder/raster/triangle_kernels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "decoder/raster/texture_sample.h"
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

void draw(const TriangleList& list, const Shading& shading, DepthPlane& depth) {
  plain::draw_triangles(list, shading, depth);
}

int covered(const DepthPlane& depth, const SampleArea& part) {
  return plain::count_covered(depth, part);
}

#else

namespace hn = hwy::HWY_NAMESPACE;

/// Samples drawn together.
using Wide = hn::CappedTag<std::int32_t, 8>;
using Numbers = hn::Vec<Wide>;
using Offsets = hn::Rebind<std::uint32_t, Wide>;
using Short = hn::Rebind<std::int16_t, Wide>;
using Unsigned = hn::Rebind<std::uint16_t, Wide>;
using Bytes = hn::Rebind<std::uint8_t, Wide>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Wide()));

alignas(32) constexpr std::int32_t kNumbers[8] = {0, 1, 2, 3, 4, 5, 6, 7};

/// first, first + step, ... modulo 2^32
HWY_INLINE Numbers series(std::int32_t first, std::int32_t step) {
  const Wide d;
  return hn::Add(hn::Set(d, first), hn::Mul(hn::Load(d, kNumbers), hn::Set(d, step)));
}

std::int32_t low(std::int64_t value) {
  return static_cast<std::int32_t>(value);
}

/// Rows that are covered, then shaded: what is kept of them stays in a cache of the second level.
constexpr int kBandRows = 32;  // bits of a word

/// Draws the planes of one scale, band by band.
class Painter {
 public:
  Painter(const TriangleList& list, const Shading& shading, DepthPlane& depth)
      : list_(list),
        shading_(shading),
        depth_(depth),
        stride_(depth.area.x1 - depth.area.x0 + kLanes),
        memory_(static_cast<std::size_t>(stride_ * kBandRows) * list.quantity_count) {
    for (auto& row : samples_) row.resize(static_cast<std::size_t>(stride_));
  }

  void draw() {
    const SampleArea& area = depth_.area;
    for (first_row_ = area.y0; first_row_ < area.y1; first_row_ += kBandRows) {
      const int end = std::min(first_row_ + kBandRows, area.y1);
      for (const DrawnTriangle& t : list_.triangles)
        if (t.box.y0 < end && t.box.y1 > first_row_) t.is_short ? cover(t, end) : cover_long(t, end);
      for (int y = first_row_; y < end; ++y) shade(y);
    }
  }

 private:
  [[nodiscard]] std::ptrdiff_t place(int x, int y) const {
    return std::ptrdiff_t{y - first_row_} * stride_ + (x - depth_.area.x0);
  }
  [[nodiscard]] std::int32_t* quantity(std::size_t q) {
    return memory_.data() + static_cast<std::ptrdiff_t>(q) * stride_ * kBandRows;
  }

  /// What is linear, in a row of kLanes samples.
  struct Lanes {
    Numbers value;
    Numbers step;  ///< to the next row
    HWY_INLINE Lanes(const LinearPlane& plane, int x, int y)
        : value(series(low(plane.at(x, y)), low(plane.dx))), step(hn::Set(Wide(), low(plane.dy))) {}
    HWY_INLINE void advance() { value = hn::Add(value, step); }
  };

  /// Records depth and quantities of the samples that are nearer, in columns of kLanes samples.
  void cover(const DrawnTriangle& t, int end) {
    const Wide d;
    const int y0 = std::max(first_row_, t.box.y0), rows = std::min(end, t.box.y1) - y0;
    const std::ptrdiff_t width = depth_.width, stride = stride_;
    const auto quantities = list_.quantities_of(t).first(t.used);
    const auto edge = [&](const Edge& e, int x) HWY_ATTR { return Lanes({e.c, e.a, e.b}, x, y0); };
    Numbers nearer[kBandRows];
    for (int x = t.box.x0; x < t.box.x1; x += kLanes) {
      Lanes a = edge(t.edges[0], x), b = edge(t.edges[1], x), c = edge(t.edges[2], x), here(t.depth, x, y0);
      // The area may end before the triangle.
      const Numbers beyond = hn::VecFromMask(d, hn::Gt(hn::Load(d, kNumbers), hn::Set(d, t.box.x1 - 1 - x)));
      std::uint32_t drawn = 0;  // a bit for each row
      std::int32_t* depth = depth_.row(y0) + x;
      for (int k = 0; k < rows; ++k, depth += width) {
        const Numbers outside = hn::Or(hn::Or(a.value, b.value), hn::Or(c.value, beyond));  // if negative
        const Numbers there = hn::LoadU(d, depth);
        const auto is_nearer = hn::And(hn::Gt(outside, hn::Set(d, -1)), hn::Lt(here.value, there));
        hn::StoreU(hn::IfThenElse(is_nearer, here.value, there), d, depth);
        nearer[k] = hn::VecFromMask(d, is_nearer);
        drawn |= static_cast<std::uint32_t>(!hn::AllFalse(d, is_nearer)) << k;
        a.advance();
        b.advance();
        c.advance();
        here.advance();
      }
      if (drawn == 0) continue;
      const int first = std::countr_zero(drawn), last = 31 - std::countl_zero(drawn);
      std::int32_t* to = memory_.data() + place(x, y0 + first);
      for (const LinearPlane& plane : quantities) {
        Lanes q(plane, x, y0 + first);
        std::int32_t* out = to;
        for (int k = first; k <= last; ++k, out += stride, q.advance())
          hn::StoreU(hn::IfThenElse(hn::MaskFromVec(nearer[k]), q.value, hn::LoadU(d, out)), d, out);
        to += stride * kBandRows;
      }
    }
  }

  /// The same for a triangle whose numbers do not fit 32 bits: they are clamped to what counts of them.
  void cover_long(const DrawnTriangle& t, int end) {
    const auto quantities = list_.quantities_of(t);
    const auto most = [&](std::size_t q) {
      return shading_.has_light() && (q == 2 || q == 3) ? kMaxSampleLight : std::int64_t{1} << 30;
    };
    plain::cover(t, first_row_, end, depth_, [&](int y, RowRun run) {
      for (std::size_t q = 0; q < quantities.size(); ++q)
        for (int x = run.first; x <= run.last; ++x)
          quantity(q)[place(x, y)] = low(std::clamp(quantities[q].at(x, y), -most(q), most(q)));
    });
  }

  /// First sample from x on that is covered, or is not.
  HWY_INLINE int next(const std::int32_t* depth, int x, bool is_covered) const {
    const Wide d;
    const Numbers nothing = hn::Set(d, kNothingDrawn);
    const int end = depth_.area.x1;
    for (; x < end; x += kLanes) {
      const auto none = hn::Eq(hn::LoadU(d, depth + x), nothing);
      if (const auto k = hn::FindFirstTrue(d, is_covered ? hn::Not(none) : none); k >= 0)
        return std::min(x + static_cast<int>(k), end);
    }
    return end;
  }

  void shade(int y) {
    const std::int32_t* const depth = depth_.row(y);
    for (int x = next(depth, depth_.area.x0, true); x < depth_.area.x1;) {
      const int end = next(depth, x, false);
      shade_span(y, x, end);
      x = next(depth, end, true);
    }
  }

  /// Draws covered samples.
  void shade_span(int y, int begin, int end) {
    const int count = end - begin;
    const std::ptrdiff_t from = place(begin, y);
    if (shading_.texture.front().width > 0) {
      if (shading_.target.size() == 2)
        sample<2, false>(from, count);
      else if (shading_.light == LightUse::kAdded)
        sample<1, true>(from, count);
      else
        sample<1, false>(from, count);
    }
    if (shading_.light == LightUse::kTakenBack) take_back_light(from, count);
    for (std::size_t p = 0; p < shading_.target.size(); ++p) {
      if (shading_.still_count() > 0) blend(p, y, begin, count);
      std::copy_n(samples_[p].data(), count, shading_.target[p].row(y) + begin);
    }
  }

  /// Positions in a texture.
  struct Places {
    std::uint32_t offset[kLanes];   ///< of the top left one of four samples
    hn::Vec<Unsigned> right, down;  ///< fractions, 0..256; 256 at the last column and row
  };
  static HWY_INLINE void find_places(Numbers u, Numbers v, const ConstPlaneView& texture, Places& out) {
    const Wide d;
    const auto clamped = [&](Numbers at, int size) HWY_ATTR {
      return hn::Min(hn::Max(at, hn::Zero(d)), hn::Set(d, (size - 1) << 16));
    };
    const auto whole = [&](Numbers at, int size)
                           HWY_ATTR { return hn::Min(hn::ShiftRight<16>(at), hn::Set(d, size - 2)); };
    const auto fraction = [&](Numbers at, Numbers from) HWY_ATTR {
      return hn::BitCast(Unsigned(),
                         hn::DemoteTo(Short(), hn::Sub(hn::ShiftRight<8>(at), hn::ShiftLeft<8>(from))));
    };
    u = clamped(u, texture.width);
    v = clamped(v, texture.height);
    const Numbers column = whole(u, texture.width), row = whole(v, texture.height),
                  stride = hn::Set(d, static_cast<std::int32_t>(texture.stride));
    hn::StoreU(hn::BitCast(Offsets(), hn::Add(hn::Mul(row, stride), column)), Offsets(), out.offset);
    out.right = fraction(u, column);
    out.down = fraction(v, row);
  }

  /// Loads pairs one by one, the left sample in the low byte. (Gathers take longer: x86 processors since 2023
  /// make them slow on purpose.)
  static HWY_INLINE hn::Vec<Unsigned> pairs(const std::uint8_t* from, const std::uint32_t* offset) {
    const auto load = [&](int k) {
      std::uint16_t pair = 0;
      std::memcpy(&pair, from + offset[k], sizeof pair);
      return std::endian::native == std::endian::little ? pair
                                                        : static_cast<std::uint16_t>(pair << 8 | pair >> 8);
    };
    auto out = hn::Set(Unsigned(), load(0));
    out = hn::InsertLane(out, 1, load(1));
    out = hn::InsertLane(out, 2, load(2));
    out = hn::InsertLane(out, 3, load(3));
    if constexpr (kLanes == 8) {
      out = hn::InsertLane(out, 4, load(4));
      out = hn::InsertLane(out, 5, load(5));
      out = hn::InsertLane(out, 6, load(6));
      out = hn::InsertLane(out, 7, load(7));
    }
    return out;
  }

  static HWY_INLINE hn::Vec<Unsigned> bilinear(const ConstPlaneView& texture, const Places& at) {
    const Unsigned u;
    const auto left = hn::Sub(hn::Set(u, 256), at.right), share = hn::ShiftLeft<8>(at.down);
    const auto across = [&](const std::uint8_t* from) HWY_ATTR {
      const auto pair = pairs(from, at.offset);
      return hn::Add(hn::Mul(hn::And(pair, hn::Set(u, 255)), left),
                     hn::Mul(hn::ShiftRight<8>(pair), at.right));
    };
    auto top = across(texture.data);
    const auto bottom = across(texture.data + texture.stride);
    top = hn::IfThenElse(hn::Eq(at.down, hn::Set(u, 256)), bottom, top);
    // (bottom - top) times the lower share, modulo 2^16: where top is larger, the difference has 2^16 too
    // much.
    const auto too_much = hn::IfThenElseZero(hn::Lt(bottom, top), share);
    const auto more = hn::Sub(hn::MulHigh(hn::Sub(bottom, top), share), too_much);
    return hn::ShiftRight<8>(hn::Add(hn::Add(top, more), hn::Set(u, 128)));
  }

  /// Clamps samples to 0..255.
  static HWY_INLINE void store(Numbers samples, std::uint8_t* out) {
    hn::StoreU(hn::DemoteTo(Bytes(), samples), Bytes(), out);
  }

  /// lit(), for light within its limits, before store() clamps it
  static HWY_INLINE Numbers under_light(Numbers luma, Numbers offset, Numbers gain) {
    const Wide d;
    const Numbers by_gain =
        hn::ShiftRight<6>(hn::Mul(hn::Sub(luma, hn::Set(d, 128)), hn::ShiftRight<8>(gain)));
    return hn::ShiftRight<12>(hn::Add(hn::Add(hn::ShiftLeft<12>(luma), hn::ShiftRight<8>(offset)),
                                      hn::Add(by_gain, hn::Set(d, 1 << 11))));
  }

  /// Draws into samples_.
  template <std::size_t kPlanes, bool kLit>
  void sample(std::ptrdiff_t from, int count) {
    const Wide d;
    // Local, as stores of samples might change members in the eyes of a compiler.
    const std::int32_t *const u = quantity(0) + from, *const v = quantity(1) + from;
    const std::int32_t* const offset = kLit ? quantity(2) + from : nullptr;
    const std::int32_t* const gain = kLit ? quantity(3) + from : nullptr;
    const ConstPlaneView texture[2] = {shading_.texture.front(), shading_.texture.back()};
    std::uint8_t* const out[2] = {samples_[0].data(), samples_[1].data()};
    for (int k = 0; k < count; k += kLanes) {
      Places at;
      find_places(hn::LoadU(d, u + k), hn::LoadU(d, v + k), texture[0], at);
      for (std::size_t p = 0; p < kPlanes; ++p) {
        const auto samples = bilinear(texture[p], at);
        if constexpr (kLit)
          store(under_light(hn::PromoteTo(d, samples), hn::LoadU(d, offset + k), hn::LoadU(d, gain + k)),
                out[p] + k);
        else
          hn::StoreU(hn::DemoteTo(Bytes(), hn::BitCast(Short(), samples)), Bytes(), out[p] + k);
      }
    }
  }

  /// Blends still sources with what is in samples_.
  void blend(std::size_t plane, int y, int begin, int count) {
    const Wide d;
    const std::size_t stills = shading_.still_count();
    const std::int32_t* const weights = quantity(list_.quantity_count - stills) + place(begin, y);
    const std::ptrdiff_t size = stride_ * kBandRows;
    const ConstPlaneView* const still = &shading_.still_plane(0, plane);
    const std::size_t planes = shading_.target.size();
    std::uint8_t* const out = samples_[plane].data();
    for (int k = 0; k < count; k += kLanes) {
      Numbers left = hn::Set(d, kWeightOne), sum = hn::Set(d, kWeightOne / 2);
      const std::int32_t* weight_at = weights + k;
      for (std::size_t s = 0; s <= stills; ++s, weight_at += size) {
        Numbers weight = left;
        if (s < stills)
          weight =
              hn::Min(hn::Max(hn::ShiftRight<kGradientOneLog2>(hn::LoadU(d, weight_at)), hn::Zero(d)), left);
        left = hn::Sub(left, weight);
        const bool is_last = hn::AllTrue(d, hn::Eq(left, hn::Zero(d)));
        if (s == 0 && is_last) break;  // the texture alone
        const Numbers sample = s == 0 ? hn::PromoteTo(d, hn::LoadU(Bytes(), out + k))
                                      : in_place(still[(s - 1) * planes], begin + k, y);
        sum = hn::Add(sum, hn::Mul(weight, sample));
        if (is_last) {
          store(hn::ShiftRight<kWeightOneLog2>(sum), out + k);
          break;
        }
      }
    }
  }

  void take_back_light(std::ptrdiff_t from, int count) {
    const std::int32_t *const offset = quantity(2) + from, *const gain = quantity(3) + from;
    for (int k = 0; k < count; ++k) samples_[0][k] = unlit(samples_[0][k], offset[k], gain[k]);
  }

  /// Samples of a plane in place; zero beyond its last column.
  static HWY_INLINE Numbers in_place(const ConstPlaneView& plane, int x, int y) {
    const Wide d;
    const Bytes b;
    const std::uint8_t* const from = plane.row(y) + x;
    if (x + kLanes <= plane.width) return hn::PromoteTo(d, hn::LoadU(b, from));
    std::uint8_t memory[kLanes] = {};
    std::copy_n(from, plane.width - x, memory);
    return hn::PromoteTo(d, hn::LoadU(b, memory));
  }

  const TriangleList& list_;
  const Shading& shading_;
  DepthPlane& depth_;
  int first_row_ = 0;  ///< of the band
  std::ptrdiff_t stride_;
  std::vector<std::int32_t> memory_;                  ///< quantities of the band, each row by row
  std::array<std::vector<std::uint8_t>, 2> samples_;  ///< of a span, in each plane
};

void draw(const TriangleList& list, const Shading& shading, DepthPlane& depth) {
  if (!depth.area.empty()) Painter(list, shading, depth).draw();
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

HWY_EXPORT(draw);
HWY_EXPORT(covered);

void draw_triangles(const TriangleList& list, const Shading& shading, DepthPlane& depth) {
  FBS_DISPATCH(draw, plain::draw_triangles)(list, shading, depth);
}

int count_covered(const DepthPlane& depth, const SampleArea& part) {
  return FBS_DISPATCH(covered, plain::count_covered)(depth, part);
}

}  // namespace fbs
#endif
