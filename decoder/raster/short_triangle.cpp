#include "decoder/raster/short_triangle.h"

#include <algorithm>
#include <cstdlib>

namespace fbs {
namespace {

constexpr std::int64_t kMaxShort = 1 << 30;

/// Shortens the quantity in a box; false if it was clamped, or exceeds 32 bits there.
bool shorten(const Gradient& g, const TriangleSetup& setup, const SampleArea& box, std::int64_t more,
             ShortGradient& out) {
  if (!g.exact()) return false;
  const std::int64_t first = g.at(setup.from_corner(box.x0, box.y0), setup.position_bits()) + more;
  const std::int64_t across = g.dx * (box.x1 - box.x0), down = g.dy * (box.y1 - box.y0);
  if (std::abs(first) + std::abs(across) + std::abs(down) >= kMaxShort) return false;
  out = {static_cast<std::int32_t>(first), static_cast<std::int32_t>(g.dx), static_cast<std::int32_t>(g.dy)};
  return true;
}

/// Samples of the target that the triangle can cover.
SampleArea box_of(const ScreenTriangle& t, const TriangleSetup& setup, const SampleArea& area) {
  const auto [left, right] = std::minmax({t[0].at.x, t[1].at.x, t[2].at.x});
  const int bits = setup.position_bits();
  return {std::max(area.x0, left >> bits), std::max(area.y0, setup.first_row()),
          std::min(area.x1, (right >> bits) + 1), std::min(area.y1, setup.last_row() + 1)};
}

/// Whether a kernel can read everything that the triangle shows, with the margin that rounding needs.
bool is_inside(const TextureSource& source, int position_bits) {
  const ConstPlaneView& plane = source.planes.front();
  const auto& c = source.corners;
  const auto [left, right] = std::minmax({c[0].x, c[1].x, c[2].x});
  const auto [top, bottom] = std::minmax({c[0].y, c[1].y, c[2].y});
  const auto fits = [&](int low, int high, int size, int read) {
    return low >> position_bits >= 2 && (high >> position_bits) + read < size;
  };
  return fits(left, right, plane.width, kReadColumns) && fits(top, bottom, plane.height, kReadRows + 1);
}

bool is_faint(const std::array<std::int32_t, 3>& light) {
  return std::all_of(light.begin(), light.end(), [](std::int32_t v) { return std::abs(v) < kMaxLight; });
}

bool is_plain(const Finish& finish) {
  return finish.light_before == nullptr;
}

/// Whether a source shows the picture's own samples in place.
bool is_still(const TextureSource& source, const ScreenTriangle& t, const RasterTarget& target) {
  const ConstPlaneView& plane = source.planes.front();
  return source.corners == std::array{t[0].at, t[1].at, t[2].at} && is_plain(source.finish) &&
         source.finish.light == nullptr && plane.width == target.planes.front().width &&
         plane.height == target.planes.front().height;
}

bool can_be_short(std::span<const TextureSource> sources, const ScreenTriangle& t,
                  const RasterTarget& target) {
  return target.depth != nullptr && sources.size() <= kMaxShortSources && is_plain(sources[0].finish) &&
         std::all_of(sources.begin() + 1, sources.end(),
                     [&](const TextureSource& s) { return is_still(s, t, target); });
}

}  // namespace

std::optional<ShortTriangle> shorten(const TriangleSetup& setup, const ScreenTriangle& triangle,
                                     std::span<const TextureSource> sources, const RasterTarget& target) {
  if (!can_be_short(sources, triangle, target)) return std::nullopt;
  const TextureSource& source = sources.front();
  const SampleArea box = box_of(triangle, setup, target.area);
  if (box.empty() || !is_inside(source, setup.position_bits())) return std::nullopt;
  const auto& c = source.corners;
  ShortTriangle out{RunWalker(setup, box.y0, box),  box, {}, {}, {}, {}, {},
                    source.finish.light != nullptr, {}};
  constexpr std::int64_t kHalf = 1 << 15;  // from positions whose integers are between samples to centres
  const auto quantity = [&](const std::array<std::int32_t, 3>& value, int bits, std::int64_t more,
                            ShortGradient& to) {
    return shorten(setup.gradient(value, bits), setup, box, more, to);
  };
  if (!quantity({c[0].x, c[1].x, c[2].x}, setup.position_bits(), -kHalf, out.u) ||
      !quantity({c[0].y, c[1].y, c[2].y}, setup.position_bits(), -kHalf, out.v) ||
      !quantity({triangle[0].depth, triangle[1].depth, triangle[2].depth}, kGradientOneLog2, 0, out.depth))
    return std::nullopt;
  for (std::size_t k = 0; k + 1 < sources.size(); ++k)
    if (!quantity(sources[k].weight, 0, 0, out.weight[k])) return std::nullopt;
  if (!out.has_light) return out;
  const Light& light = *source.finish.light;
  if (!is_faint(light.offset) || !is_faint(light.gain) || !quantity(light.offset, 0, 0, out.offset) ||
      !quantity(light.gain, 0, 0, out.gain))
    return std::nullopt;
  return out;
}

}  // namespace fbs
