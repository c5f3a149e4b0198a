// Automatic marks: where the features of a found face are.
#pragma once

#include "common/picture.h"
#include "encoder/find/face_finder.h"
#include "encoder/find/marks.h"

namespace fbs {

/// Marks a found face from image evidence: its yaw first, then mouth line and nose base together, the borders
/// of the lips (which may be open), corners, brows, chin, face sides; lids by proportion from the eyes found.
/// Each point is searched near where the generic head has it and stays within anatomical limits; where the
/// picture says nothing, the proportion is kept.
[[nodiscard]] Marks find_marks(const Picture& picture, const FoundFace& face);

}  // namespace fbs
