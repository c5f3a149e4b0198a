// The borders of the lips on the midline: of a mouth that may be open.
#pragma once

#include "encoder/find/face_frame.h"

namespace fbs {

/// y of each border, eye distances below the eyes.
struct LipBorders {
  double top, inner_top, inner_bottom, bottom;
};

/// Skin, upper lip, opening, lower lip, skin along the midline: the four borders that leave the least
/// variance of brightness and redness between them, near where lips usually are.
/// @param middle  x of the mouth's middle
/// @param line    y of the dark line between the lips, near which they are searched
[[nodiscard]] LipBorders find_lip_borders(const FaceFrame& face, double middle, double line);

}  // namespace fbs
