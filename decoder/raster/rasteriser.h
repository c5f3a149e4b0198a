// Draws textured triangles into planes: paper section 2.1, "smearing" the pattern and removing hidden
// surfaces. SPEC 10. Integers only.
//
// Which triangle a sample shows is found first, so that each is drawn once, beside its neighbours.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

#include "decoder/raster/triangle_kernels.h"

namespace fbs {

/// Planes of one scale: Y; U and V.
[[nodiscard]] constexpr std::size_t plane_count(PlaneScale scale) {
  return scale == PlaneScale::kLuma ? 1 : 2;
}

/// A source of a triangle.
struct LookSource {
  std::size_t source;                  ///< 0: the texture; k: still source k - 1
  std::array<std::int32_t, 3> weight;  ///< at the corners, 0..kWeightOne; linear over the triangle
};

/// What a triangle shows.
struct TriangleLook {
  /// The triangle's corners in the texture, 1/64 luma pixel, as ScreenVertex::at.
  std::array<glm::ivec2, 3> corners;
  /// Light of the texture at the corners, as VertexLight.
  std::array<std::int32_t, 3> offset{}, gain{};
  /// What is blended, by rising number. The last gets the remainder, whatever its own weight. None: the
  /// texture.
  std::span<const LookSource> sources{};
};

/// Draws the triangles in the planes of one scale. Keeps memory between pictures, nothing else.
class Rasteriser {
 public:
  /// Forgets all triangles; nothing is drawn yet.
  /// @param area  the samples of the target that may be drawn
  void start(PlaneScale scale, const SampleArea& area, const Shading& shading);

  /// Adds a triangle to be drawn: it is shown by the samples in the area whose centre is inside (top-left
  /// rule), unless the depth of another is less there, or the same and that one was added before. A triangle
  /// that is anticlockwise on the screen or has no area has no samples.
  void add(const ScreenTriangle& triangle, const TriangleLook& look);

  /// What draw() draws.
  [[nodiscard]] const TriangleList& triangles() const { return list_; }

  /// Draws all samples that show a triangle; leaves the others alone.
  void draw() { draw_triangles(list_, shading_, depth_); }

  /// The depth of what was drawn.
  [[nodiscard]] const DepthPlane& depth() const { return depth_; }

 private:
  PlaneScale scale_{};
  Shading shading_{};
  DepthPlane depth_;
  TriangleList list_;
};

}  // namespace fbs
