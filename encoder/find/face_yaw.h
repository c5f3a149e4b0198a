// Yaw of the face in the first picture.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "encoder/find/face_frame.h"

namespace fbs {

struct FaceYaw {
  double tangent = 0;  ///< of the yaw; positive: towards the picture's left, as in HeadPose
  double shift = 0;  ///< the middle between the eyes lies this far to the right of the frame's, eye distances

  /// x of what lies on the head's midline at a depth behind the eyes, eye distances.
  [[nodiscard]] double midline(double depth) const { return shift + tangent * depth; }
  /// Where a point of the generic head is seen, rotated; depth moves it aside.
  [[nodiscard]] glm::dvec2 seen(glm::dvec3 p) const { return {shift + p.x + tangent * p.z, p.y}; }
};

/// Yaw is estimated from the face outline, nose and mouth: the one at which the generic head explains the
/// picture best. Relative to the eyes, the sides of the face move to one side and nose and mouth to the
/// other, each by its depth. The sides show by a step of brightness or colour, nose and mouth by the likeness
/// of their halves. Where eyes were found a little aside, all of it shifts. Measured on 91 pictures of ten
/// clips: correlation 0.84 with an independent tracker's yaw, 3.5 degrees rms.
/// @return tangent within +-0.5; near 0 without evidence
[[nodiscard]] FaceYaw estimate_yaw(const FaceFrame& face);

}  // namespace fbs
