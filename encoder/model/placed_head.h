// The head of a fit where the picture sees it.
#pragma once

#include "encoder/model/fit.h"
#include "encoder/model/skinning.h"
#include "encoder/model/surface.h"

namespace fbs {

struct PlacedHead {
  HeadVertices vertices;
  PoseProjection projection;

  PlacedHead(const Geometry& geometry, const Fit& fit);

  /// Pixels.
  [[nodiscard]] glm::dvec2 operator()(const SurfacePoint& p) const { return projection(p.on(vertices)); }

  /// Area of a triangle in the picture, square pixels; zero when it faces away.
  [[nodiscard]] double visible_area(const HeadTriangle& triangle) const;
};

}  // namespace fbs
