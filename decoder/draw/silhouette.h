// Softens the picture along silhouettes, where the head hides what is far behind. SPEC 10.13. Integers only.
//
// Rasterised, a silhouette is a jagged line, and lies a little off the one in the source: viewers take it for
// a cut.
#pragma once

#include <span>

#include "common/picture.h"
#include "decoder/animate/screen_mesh.h"
#include "decoder/blend/head_weights.h"
#include "decoder/head/head_mesh.h"
#include "decoder/raster/row_runs.h"

namespace fbs {

/// Samples round a silhouette that change at most.
inline constexpr int kMaxSoftened = 8;

/// Samples round an area that can change what is softened in it.
inline constexpr int kSilhouetteReach = 2 * kMaxSoftened + 2;

/// Leaves alone what still sources show: there the picture is as it was seen.
/// @param depth   of the head
/// @param planes  in which it has been drawn
void soften_silhouettes(const ScreenMesh& mesh, const HeadMesh& head, const HeadWeights& weights,
                        PlaneScale scale, const DepthPlane& depth, std::span<const PlaneView> planes);

}  // namespace fbs
