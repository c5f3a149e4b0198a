#include "encoder/image/work_frame.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "encoder/image/planes.h"

namespace fbs {
namespace {

/// Half width and half height of the crop, eye distances; the centre is between the eyes, moved down by
/// kDown.
constexpr double kHalfWidth = 2.1, kHalfHeight = 2.5, kDown = 0.6;

/// Cuts [x0, x0 + w) x [y0, y0 + h) (plane samples, whole) out of a plane, repeating its border, and resizes
/// it.
cv::Mat resized_crop(const Plane& plane, int x0, int y0, int w, int h, cv::Size size) {
  const cv::Mat whole = view(plane);
  const cv::Rect wanted(x0, y0, w, h), inside = wanted & cv::Rect(0, 0, plane.width, plane.height);
  cv::Mat crop;
  if (inside == wanted) {
    crop = whole(wanted);
  } else if (inside.empty()) {
    crop = cv::Mat(h, w, CV_8UC1, cv::Scalar(128));
  } else {
    cv::copyMakeBorder(whole(inside), crop, inside.y - y0, y0 + h - inside.br().y, inside.x - x0,
                       x0 + w - inside.br().x, cv::BORDER_REPLICATE);
  }
  cv::Mat out;
  cv::resize(crop, out, size, 0, 0, size.width < w ? cv::INTER_AREA : cv::INTER_LINEAR);
  return out;
}

}  // namespace

WorkFrame WorkFrame::cut(const Picture& picture, glm::dvec2 centre, double eye_distance_px,
                         bool with_colour) {
  // Whole even samples, so that luma and chroma cover the same area exactly.
  const auto even = [](double x) { return 2 * static_cast<int>(std::lround(x / 2)); };
  const int w = std::max(16, even(2 * kHalfWidth * eye_distance_px));
  const int h = std::max(16, even(2 * kHalfHeight * eye_distance_px));
  const int x0 = even(std::clamp(centre.x, 0.0, 1.0 * picture.width()) - w / 2.0);
  const int y0 = even(std::clamp(centre.y, 0.0, 1.0 * picture.height()) + kDown * eye_distance_px - h / 2.0);

  WorkFrame frame;
  const double wanted = kWorkEyeDistance / eye_distance_px;
  const cv::Size size(static_cast<int>(std::lround(w * wanted)), static_cast<int>(std::lround(h * wanted)));
  frame.scale = static_cast<double>(size.width) / w;
  frame.origin = {x0, y0};
  frame.luma = resized_crop(picture.y, x0, y0, w, h, size);
  if (with_colour) {
    frame.u = resized_crop(picture.u, x0 / 2, y0 / 2, w / 2, h / 2, size);
    frame.v = resized_crop(picture.v, x0 / 2, y0 / 2, w / 2, h / 2, size);
  }
  return frame;
}

}  // namespace fbs
