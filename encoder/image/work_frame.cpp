#include "encoder/image/work_frame.h"

#include <algorithm>
#include <cmath>

#include "encoder/image/planes.h"
#include "encoder/image/pyramid.h"

namespace fbs {
namespace {

/// Half width and half height of the crop, eye distances; the centre is between the eyes, moved down by
/// kDown.
constexpr double kHalfWidth = 2.1, kHalfHeight = 2.5, kDown = 0.6;

/// Cuts an area out of a plane, repeating its border, and resizes it.
cv::Mat resized_crop(const Plane& plane, const cv::Rect& wanted, cv::Size size) {
  const cv::Mat whole = view(plane);
  const cv::Rect inside = wanted & cv::Rect(0, 0, plane.width, plane.height);
  cv::Mat crop;
  if (inside == wanted) {
    crop = whole(wanted);
  } else if (inside.empty()) {
    crop = cv::Mat(wanted.size(), CV_8UC1, cv::Scalar(128));
  } else {
    cv::copyMakeBorder(whole(inside), crop, inside.y - wanted.y, wanted.br().y - inside.br().y,
                       inside.x - wanted.x, wanted.br().x - inside.br().x, cv::BORDER_REPLICATE);
  }
  return resized(crop, size);
}

}  // namespace

cv::Rect WorkFrame::area(glm::ivec2 size, glm::dvec2 centre, double eye_distance_px) {
  // Whole even samples, so that luma and chroma cover exactly the same area.
  const auto even = [](double x) { return 2 * static_cast<int>(std::lround(x / 2)); };
  const int w = std::max(16, even(2 * kHalfWidth * eye_distance_px));
  const int h = std::max(16, even(2 * kHalfHeight * eye_distance_px));
  return {even(std::clamp(centre.x, 0.0, 1.0 * size.x) - w / 2.0),
          even(std::clamp(centre.y, 0.0, 1.0 * size.y) + kDown * eye_distance_px - h / 2.0), w, h};
}

WorkFrame WorkFrame::cut(const Plane& luma, glm::dvec2 centre, double eye_distance_px) {
  const cv::Rect crop = area({luma.width, luma.height}, centre, eye_distance_px);
  const double wanted = kWorkEyeDistance / eye_distance_px;
  const cv::Size size(static_cast<int>(std::lround(crop.width * wanted)),
                      static_cast<int>(std::lround(crop.height * wanted)));
  WorkFrame frame;
  frame.scale = static_cast<double>(size.width) / crop.width;
  frame.origin = {crop.x, crop.y};
  frame.luma = resized_crop(luma, crop, size);
  return frame;
}

WorkFrame WorkFrame::cut(const Picture& picture, glm::dvec2 centre, double eye_distance_px,
                         bool with_colour) {
  WorkFrame frame = cut(picture.y, centre, eye_distance_px);
  if (!with_colour) return frame;
  const cv::Rect crop = area({picture.width(), picture.height()}, centre, eye_distance_px);
  const cv::Rect half(crop.x / 2, crop.y / 2, crop.width / 2, crop.height / 2);
  frame.u = resized_crop(picture.u, half, frame.luma.size());
  frame.v = resized_crop(picture.v, half, frame.luma.size());
  return frame;
}

}  // namespace fbs
