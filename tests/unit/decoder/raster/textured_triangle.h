// A triangle with its texture coordinates, as the rasteriser's tests write them down.
#pragma once

#include <array>

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

/// Draws one plane; within all of the target.
inline void draw(const TexturedTriangle& t, PlaneScale scale, const Plane& pattern, Plane& target,
                 DepthPlane* depth = nullptr, const Finish& finish = {}) {
  const ConstPlaneView from = pattern;
  const PlaneView to = target;
  draw_triangle(screen_of(t), {{&from, 1}, {t[0].texture, t[1].texture, t[2].texture}},
                {scale, {&to, 1}, whole(target), depth}, finish);
}

}  // namespace fbs
