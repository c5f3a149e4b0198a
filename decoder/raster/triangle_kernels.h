// The inner loops of triangles drawn from one texture. SPEC 10.6 to 10.9 and 11. Vector code for every kind
// of processor that Highway knows, chosen at run time; draw_triangle() defines the results. Integers only.
#pragma once

#include "decoder/raster/short_triangle.h"

namespace fbs {

/// Draws the samples that are nearer than the depth recorded.
/// @param sources  those the triangle was made from
/// @param target   a plane of luma, or two of chroma; light affects luma only
/// @param depth    of the target's planes
void draw_short_triangle(const ShortTriangle& triangle, PlaneScale scale,
                         std::span<const TextureSource> sources, std::span<const PlaneView> target,
                         DepthPlane& depth);

/// Samples of a part of depth.area that something was drawn on.
[[nodiscard]] int count_covered(const DepthPlane& depth, const SampleArea& part);

}  // namespace fbs
