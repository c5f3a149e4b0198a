// The picture in model space: metres, y up, z towards the viewer, origin in its middle.
#pragma once

#include <glm/vec3.hpp>

#include "common/picture.h"

namespace fbs {

/// Distance of the eyes in the model: the human average, m.
inline constexpr double kEyeDistanceMetres = 0.063;

struct PictureFrame {
  double pixel = 0;              ///< height of a pixel, m
  double aspect = 1;             ///< its width over its height
  double width = 0, height = 0;  ///< of the picture, pixels

  /// @param scale_of_first  pixels per eye distance that count as kEyeDistanceMetres
  PictureFrame(const VideoFormat& format, double scale_of_first)
      : pixel(kEyeDistanceMetres / scale_of_first), width(format.width), height(format.height) {
    if (format.pixel_aspect.num != 0 && format.pixel_aspect.den != 0)
      aspect = static_cast<double>(format.pixel_aspect.num) / format.pixel_aspect.den;
  }

  [[nodiscard]] glm::dvec3 scale() const { return {pixel * aspect, pixel, pixel}; }
  /// The picture's upper left corner, m.
  [[nodiscard]] glm::dvec3 corner() const { return {-width / 2 * pixel * aspect, height / 2 * pixel, 0}; }

  /// @param p  pixels from the upper left corner, y up
  [[nodiscard]] glm::dvec3 metres(const glm::dvec3& p) const { return corner() + scale() * p; }
};

}  // namespace fbs
