#include "tests/figures/canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "cli/video/colour.h"
#include "encoder/image/planes.h"
#include "tests/figures/wire_frame.h"

namespace fbs::figures {
namespace {

constexpr double kMargin = 0.06;  // of part_with(), of its size
constexpr int kShift = 4;         // OpenCV draws with positions in 1/16 pixel

int even(double v) {
  return 2 * static_cast<int>(std::lround(v / 2));
}

/// Samples of `from` at (corner + (x + 0.5, y + 0.5) / zoom), with positions from the plane's corner.
void enlarge(const Plane& from, cv::Point2d corner, double zoom, Plane& to) {
  const double one = 1 / zoom;
  const cv::Matx23d map(one, 0, corner.x + 0.5 * one - 0.5, 0, one, corner.y + 0.5 * one - 0.5);
  cv::Mat out(to.height, to.width, CV_8UC1, to.samples.data());
  cv::warpAffine(view(from), out, map, out.size(),
                 (zoom > 1 ? cv::INTER_CUBIC : cv::INTER_LINEAR) | cv::WARP_INVERSE_MAP,
                 cv::BORDER_REPLICATE);
}

}  // namespace

cv::Rect2d part_with(std::span<const glm::dvec2> points) {
  const auto [x0, x1] = std::ranges::minmax(points, {}, &glm::dvec2::x);
  const auto [y0, y1] = std::ranges::minmax(points, {}, &glm::dvec2::y);
  const glm::dvec2 size(x1.x - x0.x, y1.y - y0.y), margin = kMargin * size;
  return {x0.x - margin.x, y0.y - margin.y, size.x + 2 * margin.x, size.y + 2 * margin.y};
}

Canvas::Canvas(const Picture& picture, const VideoFormat& format, const cv::Rect2d& part, int width_px)
    : corner_(part.tl()), zoom_(width_px / part.width) {
  // Enlarged as a picture and then converted: chroma is interpolated, too.
  Picture large(width_px, even(part.height * zoom_));
  enlarge(picture.y, corner_, zoom_, large.y);
  enlarge(picture.u, corner_ * 0.5, zoom_, large.u);
  enlarge(picture.v, corner_ * 0.5, zoom_, large.v);
  RgbImage rgb = rgb_from_picture(large, format.range, format.matrix, ChannelOrder::kBgr);
  image_ = cv::Mat(rgb.height, rgb.width, CV_8UC3, rgb.samples.data()).clone();
}

Canvas::Canvas(const cv::Rect2d& part, int width_px, const cv::Scalar& paper)
    : corner_(part.tl()), zoom_(width_px / part.width), image_(even(part.height * zoom_), width_px) {
  image_.setTo(paper);
}

cv::Point Canvas::fixed(glm::dvec2 p) const {
  const glm::dvec2 px = ((p - glm::dvec2(corner_.x, corner_.y)) * zoom_ - 0.5) * (1.0 * (1 << kShift));
  return {static_cast<int>(std::lround(px.x)), static_cast<int>(std::lround(px.y))};
}

void Canvas::curve(std::span<const glm::dvec2> points, bool closed, const cv::Scalar& colour, int width_px) {
  std::vector<cv::Point> at;
  for (const glm::dvec2 p : points) at.push_back(fixed(p));
  // A dark rim keeps a thick line readable on teeth and on lips alike.
  if (width_px > 1) cv::polylines(image_, at, closed, {30, 30, 30}, width_px + 1, cv::LINE_AA, kShift);
  cv::polylines(image_, at, closed, colour, width_px, cv::LINE_AA, kShift);
}

void Canvas::dots(std::span<const glm::dvec2> points, const cv::Scalar& colour, double radius_px) {
  // By hand: cv::circle turns such a small circle into a diamond.
  const cv::Vec3d ink(colour[0], colour[1], colour[2]);
  const int reach = static_cast<int>(radius_px) + 2;
  for (const glm::dvec2 p : points) {
    const glm::dvec2 centre = (p - glm::dvec2(corner_.x, corner_.y)) * zoom_ - 0.5;
    const cv::Point middle(static_cast<int>(std::lround(centre.x)), static_cast<int>(std::lround(centre.y)));
    const cv::Rect box = cv::Rect(middle.x - reach, middle.y - reach, 2 * reach + 1, 2 * reach + 1) &
                         cv::Rect({0, 0}, image_.size());
    for (int y = box.y; y < box.y + box.height; ++y) {
      for (int x = box.x; x < box.x + box.width; ++x) {
        const double cover = std::clamp(radius_px + 0.5 - std::hypot(x - centre.x, y - centre.y), 0.0, 1.0);
        image_(y, x) = cv::Vec3d(image_(y, x)) * (1 - cover) + ink * cover;
      }
    }
  }
}

void Canvas::wire_frame(const WireFrame& frame, std::span<const glm::dvec3> vertices,
                        const cv::Scalar& colour) {
  for (const auto& [from, to] : visible_edges(frame, vertices))
    cv::line(image_, fixed(from), fixed(to), colour, 1, cv::LINE_AA, kShift);
}

}  // namespace fbs::figures
