// A found face brought into a frame of its own, eyes level and one unit apart.
#pragma once

#include <glm/vec2.hpp>
#include <opencv2/core.hpp>

#include "common/picture.h"

namespace fbs {

/// The face with its eyes at (-0.5, 0) and (0.5, 0); x to the picture's right, y down, in eye distances.
class FaceFrame {
 public:
  /// @param right, left  centres of the subject's eyes, pixels of the picture
  FaceFrame(const Picture& picture, glm::dvec2 right, glm::dvec2 left);

  [[nodiscard]] glm::dvec2 to_picture(glm::dvec2 p) const;
  /// Luma and Cr, bilinear, at a place in eye distances; clamped to the frame's border.
  [[nodiscard]] double luma(double x, double y) const;
  [[nodiscard]] double red(double x, double y) const;
  /// How much darker than above and below (by `reach`) it is, grey levels.
  [[nodiscard]] double valley(double x, double y, double reach) const;

 private:
  [[nodiscard]] cv::Mat warp(const Plane& plane, double plane_scale) const;

  glm::dvec2 origin_, x_axis_;  // pixels of the picture, per eye distance
  cv::Mat luma_, red_;          // float
};

}  // namespace fbs
