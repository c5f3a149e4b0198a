// A face painted in its own frame, eyes level: 50 pixels between them, at (100, 100) and (150, 100).
#pragma once

#include <cmath>
#include <functional>

#include "encoder/find/face_frame.h"

namespace fbs {

inline constexpr double kPaintedEye = 50;

/// @param luma, red  at a place in eye distances from the middle between the eyes
inline FaceFrame painted_face(
    const std::function<double(glm::dvec2)>& luma,
    const std::function<double(glm::dvec2)>& red = [](glm::dvec2) { return 128.0; }) {
  Picture picture(250, 260);
  const auto byte = [](double v) { return static_cast<std::uint8_t>(std::lround(v)); };
  for (int y = 0; y < 260; ++y)
    for (int x = 0; x < 250; ++x)
      picture.y.row(y)[x] = byte(luma((glm::dvec2(x + 0.5, y + 0.5) - glm::dvec2(125, 100)) / kPaintedEye));
  for (int y = 0; y < 130; ++y)
    for (int x = 0; x < 125; ++x)
      picture.v.row(y)[x] =
          byte(red((glm::dvec2(2 * x + 1, 2 * y + 1) - glm::dvec2(125, 100)) / kPaintedEye));
  return {picture, {100, 100}, {150, 100}};
}

/// A dark line of a width about y(x): 1 in its middle, 0 far away.
inline double ridge(double distance, double width) {
  return std::exp(-distance * distance / (2 * width * width));
}

}  // namespace fbs
