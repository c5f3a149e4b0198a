// Draws the head from its blended atlas. SPEC 10.4, 10.9 to 10.12.
#pragma once

#include <array>
#include <vector>

#include "decoder/animate/scene_geometry.h"
#include "decoder/blend/head_weights.h"
#include "decoder/draw/drawing.h"
#include "decoder/raster/rasteriser.h"

namespace fbs {

/// Draws the triangles of the head, the nearest on top.
class HeadPainter {
 public:
  /// @param raster  memory for luma and chroma
  HeadPainter(const Drawing& drawing, const SceneGeometry& geometry, const HeadWeights& weights,
              std::array<Rasteriser, 2>& raster)
      : d_(drawing), geometry_(geometry), weights_(weights), raster_(raster) {}

  /// @param atlas  AtlasBlend::planes()
  void draw(const std::array<ConstPlaneView, 3>& atlas);
  /// Softens a scale. To be called when the surround has been drawn, too.
  void soften(PlaneScale scale) const;

 private:
  [[nodiscard]] TriangleLook look_of(const MeshTriangle& triangle, const AtlasLayout& layout);

  const Drawing& d_;
  const SceneGeometry& geometry_;
  const HeadWeights& weights_;
  std::array<Rasteriser, 2>& raster_;
  std::vector<LookSource> sources_;  ///< of one triangle
};

}  // namespace fbs
