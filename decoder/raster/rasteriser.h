// Draws textured triangles into planes: paper section 2.1, "smearing" the pattern and removing hidden
// surfaces. SPEC 10. Integers only; no state between calls.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

#include "common/picture.h"
#include "decoder/raster/blend_weights.h"
#include "decoder/raster/finish.h"
#include "decoder/raster/row_runs.h"
#include "decoder/raster/triangle_setup.h"

namespace fbs {

inline constexpr std::size_t kMaxTriangleSources = 56;

/// Where the samples of a triangle come from.
struct TextureSource {
  std::span<const ConstPlaneView> planes;  ///< all of one size; as many as the scale has: plane_count()
  std::array<glm::ivec2, 3> corners;       ///< of the triangle in them, 1/64 luma pixel, as ScreenVertex::at
  Finish finish;
  /// Weight of the source in a blend, at the corners, 0..kWeightOne; linear over the triangle. The last
  /// source gets the remainder, whatever its own weight.
  std::array<std::int32_t, 3> weight{};
};

/// Where the samples go.
struct RasterTarget {
  PlaneScale scale;
  std::span<const PlaneView> planes;  ///< all of one size; plane_count(scale)
  SampleArea area;                    ///< within the planes: the samples that may be drawn
  DepthPlane* depth = nullptr;        ///< same size as the planes: only nearer samples are drawn; null: all
};

/// Draws the triangle's part of each source plane into the target's plane: the samples in the target's area
/// whose centre is inside the triangle (top-left rule). A triangle that is anticlockwise on the screen or has
/// no area is not drawn.
/// @param sources  1..kMaxTriangleSources. Light affects luma only
void draw_triangle(const ScreenTriangle& triangle, std::span<const TextureSource> sources,
                   const RasterTarget& target);

}  // namespace fbs
