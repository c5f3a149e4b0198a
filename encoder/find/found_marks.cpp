#include "encoder/find/found_marks.h"

namespace fbs {

Marks marks_of(const FoundFace& face) {
  Marks marks;
  for (int k = 0; k < kLandmarkCount; ++k)
    marks.set_landmark(k, face.landmarks.points[static_cast<std::size_t>(k)]);
  return marks;
}

}  // namespace fbs
