// Generated talkers with their landmarks. Separate from face_pictures.cpp, since OpenCV also has an Event.
#pragma once

#include <vector>

#include "common/picture.h"
#include "encoder/landmarks/shape.h"

namespace fbs {

struct DrawnFace {
  Plane luma;
  Shape landmarks;  ///< pixels; the first pixel's centre is (0.5, 0.5)
};

/// Each has another seed, light, pose and expression.
[[nodiscard]] std::vector<DrawnFace> draw_talkers(int count);

}  // namespace fbs
