// A triangle with its texture coordinates, as the rasteriser's tests write them down.
#pragma once

#include <array>
#include <span>

#include "decoder/raster/rasteriser.h"

namespace fbs {

struct TexturedVertex {
  glm::ivec2 screen;   ///< 1/64 luma pixel
  glm::ivec2 texture;  ///< 1/64 luma pixel
  std::int32_t depth = 0;
};
using TexturedTriangle = std::array<TexturedVertex, 3>;

inline ScreenTriangle screen_of(const TexturedTriangle& t) {
  return {{{t[0].screen, t[0].depth}, {t[1].screen, t[1].depth}, {t[2].screen, t[2].depth}}};
}

/// A triangle whose texture lies where it is on the screen.
inline TexturedTriangle in_place(glm::ivec2 a, glm::ivec2 b, glm::ivec2 c) {
  return {{{a, a}, {b, b}, {c, c}}};
}

inline SampleArea whole(const Plane& p) {
  return {0, 0, p.width, p.height};
}

/// Covers 24 x 20 luma samples.
inline const TexturedTriangle kLarge = in_place({-640, -640}, {5000, -640}, {-640, 5000});

/// SPEC 10.6 in its own words: a sample is covered when its centre is inside, or on an edge that is a top or
/// a left one.
inline bool covers(const TexturedTriangle& t, PlaneScale scale, int x, int y) {
  const int bits = static_cast<int>(scale);
  const std::int64_t px = (std::int64_t{x} << bits) + (1 << (bits - 1)),
                     py = (std::int64_t{y} << bits) + (1 << (bits - 1));
  if (!faces_viewer(screen_of(t))) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::ivec2 from = t[i].screen, to = t[(i + 1) % 3].screen;
    const std::int64_t side =
        std::int64_t{to.x - from.x} * (py - from.y) - std::int64_t{to.y - from.y} * (px - from.x);
    const bool top = from.y == to.y && to.x > from.x;
    const bool left = to.y < from.y;
    if (side < 0 || (side == 0 && !top && !left)) return false;
  }
  return true;
}

/// What a triangle shows of a texture, under a light.
struct Light {
  std::array<std::int32_t, 3> offset{}, gain{};
};
inline TriangleLook look_of(const TexturedTriangle& t, const Light& light = {}) {
  return {{t[0].texture, t[1].texture, t[2].texture}, light.offset, light.gain};
}

/// Draws one triangle.
/// @return the depth then
inline DepthPlane draw(const TexturedTriangle& t, PlaneScale scale, const SampleArea& area,
                       const Shading& shading, const Light& light = {}) {
  Rasteriser raster;
  raster.start(scale, area, shading);
  raster.add(screen_of(t), look_of(t, light));
  raster.draw();
  return raster.depth();
}

/// Draws one plane within all of the target. As chroma it is drawn twice, the second time into nowhere.
inline DepthPlane draw(const TexturedTriangle& t, PlaneScale scale, const Plane& pattern, Plane& target,
                       const Light& light = {}, LightUse use = LightUse::kNone) {
  Plane nowhere(target.width, target.height);
  const std::array<ConstPlaneView, 2> from = {pattern, pattern};
  const std::array<PlaneView, 2> to = {target, nowhere};
  const std::size_t planes = plane_count(scale);
  return draw(t, scale, whole(target), {std::span(from).first(planes), use, {}, std::span(to).first(planes)},
              light);
}

}  // namespace fbs
