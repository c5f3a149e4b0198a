#include "cli/display/face_overlay.h"

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace fbs::cli {
namespace {

constexpr int kShift = 4;        // OpenCV draws with positions in 1/16 pixel
constexpr int kSampleShift = 6;  // vertices are in 1/64

const cv::Scalar kMeshColour(90, 200, 90), kSnakeColour(40, 60, 255);
constexpr int kWide = 400;  // pixels of an image from which contours are drawn thicker

/// The centre of the first pixel is at 32/64 in the picture and at 0 in OpenCV.
cv::Point fixed(const glm::ivec3& p, int zoom) {
  constexpr int kHalf = 1 << (kSampleShift - 1);
  const auto scaled = [&](int v) { return (v * zoom - kHalf) >> (kSampleShift - kShift); };
  return {scaled(p.x), scaled(p.y)};
}

using Corners = std::array<cv::Point, 3>;

struct FarTriangle {
  std::int64_t depth;
  Corners corners;
};

/// Triangles that face the viewer, farthest first.
std::vector<FarTriangle> seen_triangles(const WireFrame& head, const ScreenVertices& vertices, int zoom) {
  std::vector<FarTriangle> out;
  for (const HeadTriangle& t : head.triangles) {
    const glm::ivec3 a = vertices[t[0]], b = vertices[t[1]], c = vertices[t[2]];
    const std::int64_t area = std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
    if (area <= 0) continue;
    out.push_back({std::int64_t{a.z} + b.z + c.z, {fixed(a, zoom), fixed(b, zoom), fixed(c, zoom)}});
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const FarTriangle& a, const FarTriangle& b) { return a.depth > b.depth; });
  return out;
}

using Marks = std::initializer_list<std::uint8_t>;  // iBUG-68

/// A smooth curve through the points: cubic pieces of Catmull and Rom, 1974.
std::vector<cv::Point> smooth(const std::vector<cv::Point>& points, bool closed) {
  constexpr int kPieces = 6;
  const int n = static_cast<int>(points.size());
  const auto at = [&](int i) -> cv::Point2d {
    const int k = closed ? (i + n) % n : std::clamp(i, 0, n - 1);
    return points[static_cast<std::size_t>(k)];
  };
  std::vector<cv::Point> out;
  for (int i = 0; i < (closed ? n : n - 1); ++i)
    for (int piece = 0; piece < kPieces; ++piece) {
      const double t = static_cast<double>(piece) / kPieces;
      const cv::Point2d a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
      out.emplace_back(0.5 * (2 * b + t * (c - a) + t * t * (2 * a - 5 * b + 4 * c - d) +
                              t * t * t * (3 * b - a - 3 * c + d)));
    }
  if (!closed) out.push_back(points.back());
  return out;
}

void draw_curve(cv::Mat& image, const WireFrame& head, const ScreenVertices& vertices, int zoom, Marks marks,
                bool closed) {
  std::vector<cv::Point> points;
  for (const std::uint8_t mark : marks)
    points.push_back(fixed(vertices[head.vertex_of_landmark(mark)], zoom));
  cv::polylines(image, smooth(points, closed), closed, kSnakeColour, image.cols >= kWide ? 2 : 1, cv::LINE_AA,
                kShift);
}

}  // namespace

void draw_wire_frame(cv::Mat& image, const WireFrame& head, const ScreenVertices& vertices, int zoom) {
  cv::Mat lines(image.size(), CV_8UC1, cv::Scalar(0));
  for (const FarTriangle& t : seen_triangles(head, vertices, zoom)) {
    // A nearer triangle erases what lies behind it.
    cv::fillConvexPoly(lines, t.corners.data(), 3, cv::Scalar(0), cv::LINE_8, kShift);
    for (std::size_t i = 0; i < 3; ++i)
      cv::line(lines, t.corners[i], t.corners[(i + 1) % 3], cv::Scalar(255), 1, cv::LINE_AA, kShift);
  }
  image.forEach<cv::Vec3b>([&](cv::Vec3b& pixel, const int* place) {
    const int share = lines.at<std::uint8_t>(place[0], place[1]);
    if (share == 0) return;
    for (int c = 0; c < 3; ++c)
      pixel[c] = static_cast<std::uint8_t>((pixel[c] * (255 - share) + kMeshColour[c] * share) / 255);
  });
}

void draw_contours(cv::Mat& image, const WireFrame& head, const ScreenVertices& vertices, int zoom) {
  draw_curve(image, head, vertices, zoom, {48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59}, true);
  draw_curve(image, head, vertices, zoom, {60, 61, 62, 63, 64, 65, 66, 67}, true);
  draw_curve(image, head, vertices, zoom, {17, 18, 19, 20, 21}, false);
  draw_curve(image, head, vertices, zoom, {22, 23, 24, 25, 26}, false);
  draw_curve(image, head, vertices, zoom, {36, 37, 38, 39, 40, 41}, true);
  draw_curve(image, head, vertices, zoom, {42, 43, 44, 45, 46, 47}, true);
}

}  // namespace fbs::cli
