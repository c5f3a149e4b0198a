// The head of a fit, placed in the picture.
#pragma once

#include "encoder/model/fit.h"
#include "encoder/model/skinning.h"
#include "encoder/model/surface.h"

namespace fbs {

struct PlacedHead {
  HeadVertices vertices;
  PoseProjection projection;

  PlacedHead(const Geometry& geometry, const Fit& fit);

  /// Position in the picture, pixels.
  [[nodiscard]] glm::dvec2 operator()(const SurfacePoint& p) const { return projection(p.on(vertices)); }

  /// Area of a triangle in the picture, square pixels; zero when it faces away.
  [[nodiscard]] double visible_area(const HeadTriangle& triangle) const;
};

}  // namespace fbs
