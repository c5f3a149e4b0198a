// The marks of a found face.
#pragma once

#include "encoder/find/face_finder.h"
#include "encoder/find/marks.h"

namespace fbs {

/// Its 68 landmarks.
[[nodiscard]] Marks marks_of(const FoundFace& face);

}  // namespace fbs
