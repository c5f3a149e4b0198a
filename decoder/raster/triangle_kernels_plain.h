// The definition of triangle_kernels.h, one sample after another.
#pragma once

#include "decoder/raster/short_triangle.h"

namespace fbs::plain {

void draw_short_triangle(const ShortTriangle& triangle, PlaneScale scale,
                         std::span<const TextureSource> sources, std::span<const PlaneView> target,
                         DepthPlane& depth);

[[nodiscard]] int count_covered(const DepthPlane& depth, const SampleArea& part);

}  // namespace fbs::plain
