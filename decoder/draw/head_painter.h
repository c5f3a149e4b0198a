// Draws the head. SPEC 10.3, 10.4, 10.9.
#pragma once

#include <array>
#include <cstdint>

#include "decoder/draw/drawing.h"
#include "decoder/draw/triangle_sources.h"
#include "decoder/head/head_mesh.h"
#include "decoder/raster/row_runs.h"

namespace fbs {

/// Draws the triangles of the head, the nearest on top, into the planes of one scale.
class HeadPainter {
 public:
  /// @param depth  scratch memory
  HeadPainter(const Drawing& drawing, PlaneScale scale, DepthPlane& depth);

  void draw();

 private:
  void draw(const HeadTriangle& triangle);
  void add_light(const HeadTriangle& triangle, std::size_t i);
  void add_interior(const HeadTriangle& triangle, std::size_t i);

  const Drawing& d_;
  PlaneScale scale_;
  RasterTarget target_;
  TriangleSources sources_;
  std::array<Light, kMaxTriangleSources> light_;
  std::array<InteriorMix, kMaxTriangleSources> interior_;
};

}  // namespace fbs
