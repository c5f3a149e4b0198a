// Marks of the mouth: the line between the lips, its corners, and the borders of both lips.
#pragma once

#include <glm/vec2.hpp>

#include "encoder/find/face_yaw.h"
#include "encoder/find/lip_borders.h"

namespace fbs {

/// Places in the face's frame, eye distances.
struct MouthMarks {
  double line = 1.12;            ///< y of the line between the lips, or of the opening's middle
  glm::dvec2 right{-0.4, 1.12};  ///< corners
  glm::dvec2 left{0.4, 1.12};
  LipBorders lips{1.0, 1.11, 1.13, 1.28};  ///< on the midline; inner ones as far apart as the mouth is open

  /// Maps a landmark of the generic lips onto line, corners and borders.
  [[nodiscard]] glm::dvec2 place_of(int landmark) const;
};

/// @param yaw  of the face: the mouth's middle lies aside by its depth
[[nodiscard]] MouthMarks find_mouth(const FaceFrame& face, const FaceYaw& yaw);

}  // namespace fbs
