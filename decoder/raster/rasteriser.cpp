#include "decoder/raster/rasteriser.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>

#include "decoder/raster/texture_sample.h"

namespace fbs {
namespace {

/// Depths, and positions in textures and on the screen, that are short: with what rounding and sums add, they
/// fit 32 bits.
constexpr std::int32_t kMaxShortDepth = 1 << 30, kMaxShortPosition = 1 << 20, kMaxShortEdge = 1 << 16;

bool is_short(const ScreenVertex& v) {
  return v.depth > -kMaxShortDepth && v.depth < kMaxShortDepth;
}

bool is_short(const Edge& e) {
  return std::abs(e.a) < kMaxShortEdge && std::abs(e.b) < kMaxShortEdge;
}

/// A light at its limit may exceed it in between, where it is clamped.
bool is_short(std::int32_t light) {
  return std::abs(light) < kMaxSampleLight >> kGradientOneLog2;
}

bool is_short(glm::ivec2 position) {
  return std::abs(position.x) < kMaxShortPosition && std::abs(position.y) < kMaxShortPosition;
}

/// The samples that a triangle can cover.
SampleArea box_of(const ScreenTriangle& t, const TriangleSetup& setup) {
  const auto [left, right] = std::minmax({t[0].at.x, t[1].at.x, t[2].at.x});
  const int bits = setup.position_bits(), half = 1 << (bits - 1);
  return {(left - half) >> bits, setup.first_row(), ((right - half) >> bits) + 1, setup.last_row() + 1};
}

}  // namespace

void Rasteriser::start(PlaneScale scale, const SampleArea& area, const Shading& shading) {
  assert(shading.target.size() == plane_count(scale) && shading.texture.size() == shading.target.size());
  scale_ = scale;
  shading_ = shading;
  depth_.reset(shading.target[0].width, shading.target[0].height, area);
  list_.triangles.clear();
  list_.quantity_count = 2 + (shading.has_light() ? 2 : 0) + shading.still_count();
  list_.quantities.clear();
}

void Rasteriser::add(const ScreenTriangle& triangle, const TriangleLook& look) {
  if (depth_.area.empty()) return;
  const TriangleSetup setup(triangle, scale_);
  if (!setup.faces_viewer()) return;
  const SampleArea box = intersection(box_of(triangle, setup), depth_.area);
  if (box.empty()) return;
  const auto all_short = [](const auto& values) {
    return std::all_of(values.begin(), values.end(), [](const auto& v) { return is_short(v); });
  };
  bool fits = all_short(triangle) && all_short(setup.edges()) && all_short(look.corners) &&
              all_short(look.offset) && all_short(look.gain);
  const auto linear = [&](const std::array<std::int32_t, 3>& value, int bits, std::int64_t more = 0) {
    const Gradient g = setup.gradient(value, bits);
    fits = fits && g.exact();
    LinearPlane out = setup.over_plane(g);
    out.first += more;
    return out;
  };
  constexpr std::int64_t kHalf = 1 << 15;  // from positions whose integers are between samples to centres
  const int bits = setup.position_bits();
  const auto& c = look.corners;
  const LinearPlane depth =
      linear({triangle[0].depth, triangle[1].depth, triangle[2].depth}, kGradientOneLog2);
  std::vector<LinearPlane>& out = list_.quantities;
  out.push_back(linear({c[0].x, c[1].x, c[2].x}, bits, -kHalf));
  out.push_back(linear({c[0].y, c[1].y, c[2].y}, bits, -kHalf));
  if (shading_.has_light()) {
    out.push_back(linear(look.offset, 0));
    out.push_back(linear(look.gain, 0));
  }
  // A weight of one takes all that is left: that of the triangle's last source.
  out.resize(out.size() + shading_.still_count());
  const auto weights = std::span(out).last(shading_.still_count());
  const std::size_t last = look.sources.empty() ? 0 : look.sources.back().source;
  for (const LookSource& s : look.sources)
    if (s.source < last) weights[s.source] = linear(s.weight, 0);
  if (last < weights.size()) weights[last].first = std::int64_t{kWeightOne} << kGradientOneLog2;
  const std::size_t unused = weights.size() - std::min(last + 1, weights.size());
  list_.triangles.push_back({setup.edges(), box, depth, list_.quantity_count - unused, fits});
}

}  // namespace fbs
