#include "encoder/find/face_frame.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "encoder/image/bilinear.h"
#include "encoder/image/planes.h"

namespace fbs {
namespace {

constexpr double kRes = 64;                                               // pixels per eye distance
constexpr double kLeft = -1.6, kTop = -1.4, kWidth = 3.2, kHeight = 4.0;  // eye distances

double at(const cv::Mat& m, double x, double y) {
  const glm::dvec2 pixel((x - kLeft) * kRes, (y - kTop) * kRes);
  return bilinear<float>(m, BilinearCell(clamped(m, pixel, 1.001)));
}

}  // namespace

FaceFrame::FaceFrame(const Picture& picture, glm::dvec2 right, glm::dvec2 left)
    : origin_(0.5 * (right + left)), x_axis_(left - right) {
  luma_ = warp(picture.y, 1.0);
  red_ = warp(picture.v, 0.5);
  constexpr double kBlur = 0.02 * kRes;
  cv::GaussianBlur(luma_, luma_, {}, kBlur);
  cv::GaussianBlur(red_, red_, {}, 2 * kBlur);
}

glm::dvec2 FaceFrame::to_picture(glm::dvec2 p) const {
  return origin_ + p.x * x_axis_ + p.y * glm::dvec2(-x_axis_.y, x_axis_.x);
}

double FaceFrame::luma(double x, double y) const {
  return at(luma_, x, y);
}

double FaceFrame::red(double x, double y) const {
  return at(red_, x, y);
}

double FaceFrame::valley(double x, double y, double reach) const {
  return 0.5 * (luma(x, y - reach) + luma(x, y + reach)) - luma(x, y);
}

cv::Mat FaceFrame::warp(const Plane& plane, double plane_scale) const {
  // From own pixel (i, j) to plane sample; pixel centres at + 0.5.
  const glm::dvec2 ex = x_axis_ * plane_scale / kRes, ey(-ex.y, ex.x);
  const glm::dvec2 o = to_picture({kLeft, kTop}) * plane_scale - 0.5;
  const cv::Matx23d m(ex.x, ey.x, o.x, ex.y, ey.y, o.y);
  const cv::Size size(static_cast<int>(kWidth * kRes), static_cast<int>(kHeight * kRes));
  cv::Mat source = view(plane), out;
  const double shrink = std::hypot(ex.x, ex.y);
  if (shrink > 1.5) cv::GaussianBlur(source, source, {}, 0.4 * shrink);
  cv::warpAffine(source, out, m, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  out.convertTo(out, CV_32F);
  return out;
}

}  // namespace fbs
