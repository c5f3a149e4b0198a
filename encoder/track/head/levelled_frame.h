// A work frame with the light levelled out, at the sizes at which heads are compared.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <opencv2/core.hpp>

#include "encoder/image/pyramid.h"
#include "encoder/image/work_frame.h"
#include "encoder/model/pose.h"

namespace fbs {

/// Brightness less its local mean, over the local contrast: a face that turns under a lamp changes its
/// shading but not its features.
struct LevelledFrame {
  static constexpr int kLevels = 3;

  explicit LevelledFrame(WorkFrame of);

  /// Position in a level of a position in pixels of the picture.
  [[nodiscard]] glm::dvec2 at(glm::dvec2 picture, int level) const {
    return on_level(frame.to_work(picture), level);
  }

  WorkFrame frame;
  Pyramid<kLevels> levels;  ///< 8 bit, flat is 128; [0] has luma's size
};

/// Projects head points to a level of a work frame: affine in the point, single precision.
struct LevelProjection {
  glm::vec3 x, y;  ///< rows of the matrix
  glm::vec2 shift;

  LevelProjection(const PoseProjection& projection, const WorkFrame& frame, int level);

  [[nodiscard]] glm::vec2 operator()(glm::vec3 p) const {
    return {x.x * p.x + x.y * p.y + x.z * p.z + shift.x, y.x * p.x + y.y * p.y + y.z * p.z + shift.y};
  }
};

}  // namespace fbs
