// Draws the frames of a clip: one ray for each of 2 x 2 samples in a pixel, 8-bit 4:2:0, BT.601 limited
// range.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/picture.h"
#include "tests/talker/talker_head.h"
#include "tests/talker/talker_motion.h"
#include "tests/talker/talker_paint.h"

namespace fbs::talker {

/// A rendered clip of a talking head, with its truth. Frames may be requested in any order; the same settings
/// give the same bytes on the same machine.
class Talker {
 public:
  explicit Talker(const Settings& settings);

  [[nodiscard]] const Settings& settings() const { return settings_; }

  /// Pose, expression and light; frame 0..frame_count - 1.
  [[nodiscard]] Moment truth(int frame) const { return choreography_.at(frame); }

  /// iBUG-68 points in pixels, (0, 0) at the centre of the top left pixel; may lie on hidden skin.
  [[nodiscard]] std::array<glm::vec2, kLandmarkTotal> points(int frame) const;

  /// Which of points(frame) are visible; false when the head itself hides them.
  [[nodiscard]] std::array<bool, kLandmarkTotal> visible(int frame) const;

  [[nodiscard]] Picture picture(int frame) const;

 private:
  Settings settings_;
  Look look_;
  Choreography choreography_;
  std::vector<glm::vec3> background_;  ///< display RGB 0..1, one per pixel
};

}  // namespace fbs::talker
