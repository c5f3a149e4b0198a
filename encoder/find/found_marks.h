// The marks of a found face.
#pragma once

#include "encoder/find/face_finder.h"
#include "encoder/find/marks.h"

namespace fbs {

/// The 68 landmarks of a found face as marks.
[[nodiscard]] Marks marks_of(const FoundFace& face);

}  // namespace fbs
