// Draws the colours inside the mouth over the head, between the curves of the inner lips. SPEC 10.10.
// Integers only.
#pragma once

#include "common/wire_frame.h"
#include "decoder/draw/drawing.h"
#include "decoder/raster/triangle_setup.h"

namespace fbs {

/// Draws into the planes of one scale, once the head is in them.
/// @param head  the scene's
void draw_mouth(const Drawing& drawing, const WireFrame& head, PlaneScale scale);

}  // namespace fbs
