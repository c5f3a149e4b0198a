// An enlarged part of a picture, to draw on in picture coordinates.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "common/picture.h"
#include "common/wire_frame.h"

namespace fbs::figures {

// Blue, green, red.
inline const cv::Scalar kOuterLips(40, 220, 255), kInnerLips(60, 140, 255), kBrows(120, 235, 90),
    kLids(255, 215, 80), kMesh(170, 255, 150), kMark(70, 70, 255);

[[nodiscard]] inline cv::Rect2d whole_picture(const VideoFormat& format) {
  return {0, 0, static_cast<double>(format.width), static_cast<double>(format.height)};
}

/// The smallest rectangle with these points and some margin.
[[nodiscard]] cv::Rect2d part_with(std::span<const glm::dvec2> points);

/// Positions are pixels of the picture; the first pixel's centre is (0.5, 0.5).
class Canvas {
 public:
  /// @param part      of the picture; beyond its border the border is repeated
  /// @param width_px  of the canvas, even; its height follows from the part's shape
  Canvas(const Picture& picture, const VideoFormat& format, const cv::Rect2d& part, int width_px);

  /// A blank canvas.
  Canvas(const cv::Rect2d& part, int width_px, const cv::Scalar& paper);

  void curve(std::span<const glm::dvec2> points, bool closed, const cv::Scalar& colour, int width_px = 2);
  void dots(std::span<const glm::dvec2> points, const cv::Scalar& colour, double radius_px);
  /// The edges of triangles that can be seen: visible_edges().
  void wire_frame(const WireFrame& frame, std::span<const glm::dvec3> vertices, const cv::Scalar& colour);

  [[nodiscard]] const cv::Mat3b& image() const { return image_; }

 private:
  [[nodiscard]] cv::Point fixed(glm::dvec2 p) const;

  cv::Point2d corner_;
  double zoom_;
  cv::Mat3b image_;
};

}  // namespace fbs::figures
