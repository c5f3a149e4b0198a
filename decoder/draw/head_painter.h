// Draws the head from its blended atlas. SPEC 10.4, 10.9 to 10.12.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "decoder/animate/scene_geometry.h"
#include "decoder/atlas/atlas_layout.h"
#include "decoder/blend/head_weights.h"
#include "decoder/draw/drawing.h"
#include "decoder/raster/rasteriser.h"
#include "decoder/raster/row_runs.h"

namespace fbs {

/// Textures of the head's triangles.
struct HeadTexture {
  const SceneGeometry& geometry;
  const AtlasLayout& layout;
  std::array<ConstPlaneView, 3> atlas;  ///< AtlasBlend::planes()
  const HeadWeights& weights;
};

/// Draws the triangles of the head, the nearest on top, into the planes of one scale.
class HeadPainter {
 public:
  /// @param depth  scratch memory
  HeadPainter(const Drawing& drawing, const HeadTexture& texture, PlaneScale scale, DepthPlane& depth);

  void draw();
  /// To be called when the surround has been drawn, too.
  void soften();

  [[nodiscard]] PlaneScale scale() const { return scale_; }

 private:
  void draw(const HeadTriangle& triangle);

  const Drawing& d_;
  const HeadTexture& texture_;
  PlaneScale scale_;
  RasterTarget target_;
  std::vector<TextureSource> sources_;  ///< of one triangle
};

}  // namespace fbs
