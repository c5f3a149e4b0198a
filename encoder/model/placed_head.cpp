#include "encoder/model/placed_head.h"

#include <algorithm>

namespace fbs {

PlacedHead::PlacedHead(const Geometry& geometry, const Fit& fit)
    : vertices(skinned(geometry, fit.offsets)), projection(fit.pose) {}

double PlacedHead::visible_area(const HeadTriangle& triangle) const {
  const auto corner = [&](std::size_t i) { return projection(vertices[triangle[i]]); };
  const glm::dvec2 p = corner(0), a = corner(1) - p, b = corner(2) - p;
  return std::max(0.0, 0.5 * (a.x * b.y - a.y * b.x));
}

}  // namespace fbs
