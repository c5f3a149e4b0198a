#include "tests/figures/painted_mouth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "common/generic_head.h"

namespace fbs {
namespace {

constexpr int kSize = 192;  // pixels, both ways
constexpr double kEyeDistance_px = 96;
constexpr double kMouthY = 1.1;  // in the middle of the picture, eye distances
constexpr int kFiner = 4;        // painted this much larger, then averaged

// Y, U, V of a fair skin in soft light.
const cv::Scalar kSkin(160, 110, 150), kLips(105, 116, 168), kTeeth(212, 122, 132), kDark(28, 126, 134);

using Outline = std::vector<glm::dvec2>;  // eye distances, head frame

glm::dvec2 vertex(int landmark) {
  const auto v = vertex_of_landmark(landmark);
  const glm::ivec3 p = generic_head().vertices[v].position;
  return glm::dvec2(p.x, p.y) / static_cast<double>(kUnitsPerEyeDistance);
}

/// The polyline of landmarks from one corner of the lips to the other with its edges cut (Chaikin 1974), sunk
/// by `open` in the middle and not at all at the corners.
Outline arc(std::initializer_list<int> landmarks, double open) {
  Outline line;
  for (const int k : landmarks) line.push_back(vertex(k));
  for (int round = 0; round < 3; ++round) {
    Outline cut{line.front()};
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      cut.push_back(0.75 * line[i] + 0.25 * line[i + 1]);
      cut.push_back(0.25 * line[i] + 0.75 * line[i + 1]);
    }
    cut.push_back(line.back());
    line = std::move(cut);
  }
  const double corner = line.front().x;
  for (glm::dvec2& p : line) p.y += open * (1 - (p.x / corner) * (p.x / corner));
  return line;
}

Outline upper_border() {
  return arc({48, 49, 50, 51, 52, 53, 54}, 0);
}

Outline lower_border(double open) {
  return arc({54, 55, 56, 57, 58, 59, 48}, open);
}

/// There over `upper`, back under `lower`.
Outline between(Outline upper, const Outline& lower) {
  upper.insert(upper.end(), lower.begin(), lower.end());
  return upper;
}

void fill(cv::Mat& planes, const Outline& outline, const cv::Scalar& colour) {
  constexpr int kShift = 4;
  std::vector<cv::Point> points;
  for (const glm::dvec2 p : outline) {
    const glm::dvec2 px = ((p - glm::dvec2(0, kMouthY)) * kEyeDistance_px + kSize / 2.0) * (1.0 * kFiner);
    points.emplace_back(static_cast<int>(px.x * (1 << kShift)), static_cast<int>(px.y * (1 << kShift)));
  }
  cv::fillPoly(planes, std::vector<std::vector<cv::Point>>{points}, colour, cv::LINE_8, kShift);
}

}  // namespace

Geometry painted_geometry() {
  Geometry g;
  for (std::size_t v = 0; v < kVertexCount; ++v) g.positions[v] = generic_head().vertices[v].position;
  return g;
}

Pose painted_pose() {
  Pose pose;
  pose.shift = glm::dvec2(kSize / 2.0, kSize / 2.0 - kMouthY * kEyeDistance_px);
  pose.log2_scale = std::log2(kEyeDistance_px);
  return pose;
}

double painted_height(double open) {
  const Outline upper = upper_border(), lower = lower_border(open);
  return lower[lower.size() / 2].y - upper[upper.size() / 2].y;
}

Picture painted_mouth(double open, double teeth) {
  cv::Mat planes(kSize * kFiner, kSize * kFiner, CV_8UC3, kSkin);
  fill(planes, between(upper_border(), lower_border(open)), kLips);
  const Outline upper = arc({60, 61, 62, 63, 64}, 0);
  const auto gap = [&](double depth) { return between(upper, arc({64, 65, 66, 67, 60}, depth)); };
  fill(planes, gap(open), kDark);
  if (open > 0 && teeth > 0) fill(planes, gap(teeth * open), kTeeth);

  std::array<cv::Mat, 3> plane;
  cv::split(planes, plane.data());
  Picture out(kSize, kSize);
  const std::array<Plane*, 3> to = {&out.y, &out.u, &out.v};
  for (std::size_t k = 0; k < 3; ++k) {
    cv::Mat small;
    cv::resize(plane[k], small, {to[k]->width, to[k]->height}, 0, 0, cv::INTER_AREA);
    cv::GaussianBlur(small, small, {}, k == 0 ? 1.0 : 0.5);  // a lens; chroma has half the samples
    std::copy(small.datastart, small.dataend, to[k]->samples.begin());
  }
  return out;
}

}  // namespace fbs
