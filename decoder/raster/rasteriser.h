// Draws textured triangles into a plane: paper section 2.1, "smearing" the pattern and removing hidden
// surfaces. SPEC 10. Integers only; no state between calls.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "common/picture.h"

namespace fbs {

/// A corner of a triangle on the screen and in the pattern, both in 1/64 luma pixel from the top left corner
/// of the picture (the centre of the first pixel is at 32, 32).
struct RasterVertex {
  glm::ivec2 screen;
  glm::ivec2 texture;
  std::int32_t depth = 0;  ///< larger is farther; any unit
};
using RasterTriangle = std::array<RasterVertex, 3>;

/// Samples [x0, x1) x [y0, y1) of a plane.
struct SampleArea {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  [[nodiscard]] bool empty() const { return x0 >= x1 || y0 >= y1; }
};

/// Depth of what has been drawn so far, per sample of a plane.
struct DepthPlane {
  int width = 0;
  std::vector<std::int32_t> depth;

  /// Makes everything in `area` infinitely far; the rest keeps no meaning.
  void reset(int width, int height, const SampleArea& area);
};

enum class PlaneScale : std::uint8_t { kLuma = 6, kChroma = 7 };  ///< log2 of positions per sample

/// A plane of the pattern and the plane of the picture that it is drawn into.
struct PlanePair {
  const Plane* pattern;
  Plane* target;
  std::array<std::uint8_t, 3> shade{};  ///< what Shade mixes in where its ramp is 0, 128 and 256
};

/// A colour mixed over the pattern: `amount` / 256 of it, going through PlanePair::shade with a ramp over the
/// triangle.
struct Shade {
  std::array<std::int32_t, 3> ramp;  ///< at the corners, 0..256
  std::int32_t amount = 0;           ///< 0..256
};

/// What is added to luma: in 1/16 grey level, linear over the triangle; gain is for luma 64 levels above 128.
struct Light {
  std::array<std::int32_t, 3> offset{}, gain{};  ///< at the corners
};

/// What happens to the samples of a triangle on their way from pattern to picture. Only with depth.
struct Finish {
  const Light* light = nullptr;  ///< on the first plane
  const Shade* shade = nullptr;  ///< then mixed over all planes
};

/// Draws the triangle's part of each pattern plane into its target; all of the same size and scale. Samples
/// in `area` whose centre is inside the triangle (top-left rule) are drawn. A triangle that is anticlockwise
/// on the screen or has no area is not drawn.
/// @param area   within the targets
/// @param depth  of the targets' size: samples that are not nearer are left alone; null: all are drawn
void draw_triangle(const RasterTriangle& triangle, PlaneScale scale, std::span<const PlanePair> planes,
                   const SampleArea& area, DepthPlane* depth, const Finish& finish = {});

/// Whether the triangle faces the viewer (clockwise in the picture).
[[nodiscard]] bool faces_viewer(const RasterTriangle& triangle);

}  // namespace fbs
