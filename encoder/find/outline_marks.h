// Marks of the face outline: sides and chin.
#pragma once

#include "encoder/find/face_yaw.h"
#include "encoder/find/mouth_marks.h"

namespace fbs {

/// How the jaw differs from the generic head's.
struct JawMarks {
  double stretch = 1;          ///< of heights below the eyes
  double right = 0, left = 0;  ///< how much farther out the sides lie, as a share

  /// Where a jaw landmark is seen.
  [[nodiscard]] glm::dvec2 place_of(int landmark, const FaceYaw& yaw) const;
};

/// @param mouth  the chin is searched where it belongs to it
[[nodiscard]] JawMarks find_jaw(const FaceFrame& face, const FaceYaw& yaw, const MouthMarks& mouth);

}  // namespace fbs
