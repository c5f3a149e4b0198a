// The part of a picture around the head, at the size of the analysis.
#pragma once

#include <glm/vec2.hpp>
#include <opencv2/core.hpp>

#include "common/picture.h"

namespace fbs {

/// A crop around the predicted head, scaled so that the eye distance is about kWorkEyeDistance pixels
/// whatever the size of the picture: analysis costs the same for all.
struct WorkFrame {
  static constexpr double kWorkEyeDistance = 48;

  double scale = 1;     ///< work pixels per picture pixel; fixed for a shot
  glm::dvec2 origin{};  ///< top left corner of the crop in the picture (pixels, corner-based)
  cv::Mat luma;         ///< 8 bit
  cv::Mat u, v;         ///< 8 bit, luma's size; empty unless asked for

  /// @param centre  of the crop, pixels of the picture
  /// @param eye_distance_px  of the shot's first picture: it sets the scale and the crop's size
  static WorkFrame cut(const Picture& picture, glm::dvec2 centre, double eye_distance_px, bool with_colour);
  /// Cuts from a picture's luma alone.
  static WorkFrame cut(const Plane& luma, glm::dvec2 centre, double eye_distance_px);

  /// The crop in a picture of this size, pixels; it may reach beyond.
  static cv::Rect area(glm::ivec2 size, glm::dvec2 centre, double eye_distance_px);

  /// Positions of pixel centres: (0, 0) is the centre of the first work pixel, (0.5, 0.5) the centre of the
  /// picture's first pixel.
  [[nodiscard]] glm::dvec2 to_work(glm::dvec2 picture) const { return (picture - origin) * scale - 0.5; }
  [[nodiscard]] glm::dvec2 to_picture(glm::dvec2 work) const { return (work + 0.5) / scale + origin; }
};

}  // namespace fbs
