// Motion since the first picture of what follows the head: hair, which has no pose of its own.
#pragma once

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "encoder/model/pose.h"

namespace fbs {

/// The affine motion of the head frame's plane z = 0 between two poses.
class HeadDisplacement {
 public:
  /// @return nothing when the first pose shows that plane edge-on
  [[nodiscard]] static std::optional<HeadDisplacement> between(const Pose& seen, const Pose& now);

  /// @param place  in the first picture, pixels
  /// @return pixels
  [[nodiscard]] glm::dvec2 operator()(glm::dvec2 place) const {
    return linear_ * (place - seen_origin_) + now_origin_ - place;
  }

 private:
  glm::dmat2 linear_{1};
  glm::dvec2 seen_origin_{}, now_origin_{};
};

}  // namespace fbs
