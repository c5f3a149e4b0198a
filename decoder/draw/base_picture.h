// The picture before anything that moves is drawn. SPEC 10.3.
#pragma once

#include "decoder/draw/drawing.h"

namespace fbs {

/// Draws the patterns as they are, blended as the ground is, over the whole picture.
void draw_base(const Drawing& drawing);

}  // namespace fbs
