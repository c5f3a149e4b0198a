// Draws textured triangles into a plane: paper section 2.1, "smearing" the pattern and removing hidden surfaces.
// SPEC, "Surround and rendering". Integers only; no state between calls.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "common/picture.h"

namespace fbs {

/// A corner of a triangle on the screen and in the pattern, both in 1/64 luma pixel from the top left corner of the
/// picture (the centre of the first pixel is at 32, 32).
struct RasterVertex {
  glm::ivec2 screen;
  glm::ivec2 texture;
  std::int32_t depth = 0;  ///< larger is farther; any unit
};
using RasterTriangle = std::array<RasterVertex, 3>;

/// Depth of what has been drawn so far, per sample of a plane.
struct DepthPlane {
  int width = 0;
  std::vector<std::int32_t> depth;

  /// Everything infinitely far.
  void reset(int width, int height);
};

enum class PlaneScale : std::uint8_t { kLuma = 6, kChroma = 7 };  ///< log2 of positions per sample

/// Draws the triangle's part of `pattern` into `target`; both of the same scale. Samples whose centre is inside
/// (top-left rule) are drawn. A triangle that is anticlockwise on the screen or has no area is not drawn.
/// @param depth  of the target's size: samples that are not nearer are left alone; null: all are drawn
void draw_triangle(const RasterTriangle& triangle, const Plane& pattern, PlaneScale scale, Plane& target,
                   DepthPlane* depth);

/// Whether the triangle faces the viewer (clockwise in the picture).
[[nodiscard]] bool faces_viewer(const RasterTriangle& triangle);

}  // namespace fbs
