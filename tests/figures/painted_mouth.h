// A painted face that is only a mouth: skin, lips, and teeth before a dark gap. The case of the paper's Fig.
// 1 with nothing else in the picture.
#pragma once

#include "bitstream/syntax.h"
#include "common/picture.h"
#include "encoder/model/pose.h"

namespace fbs {

/// The unchanged generic head: every vertex of the painted mouth is at its table position.
[[nodiscard]] Geometry painted_geometry();

/// Frontal, in the middle of the picture.
[[nodiscard]] Pose painted_pose();

/// BT.601, limited range.
/// @param open  how far the middle of the lower lip has moved down, eye distances; 0: closed
/// @param teeth  fraction of the gap between the lips that they fill, from above; the rest is dark
[[nodiscard]] Picture painted_mouth(double open, double teeth);

/// Height of the outer lips in their middle, eye distances.
[[nodiscard]] double painted_height(double open);

}  // namespace fbs
