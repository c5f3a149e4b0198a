// One face with the motion of another. Paper section 3: "assign the motion of a face to the structure of
// another".
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/result.h"
#include "encoder/retarget/face_stream.h"
#include "encoder/retarget/motion_record.h"

namespace fbs {

/// A stream with geometry and patterns of `face` and the motion of `motion`. It has the picture size of
/// `face`, and the number and times of pictures of `motion`. All motion of a scene comes before its pictures
/// are shown, since patterns are named by pictures that have a state (SPEC 6).
/// @return kInternal, which is not expected
[[nodiscard]] Result<std::vector<std::uint8_t>> retarget(const MotionRecord& motion, const FaceStream& face);

}  // namespace fbs
