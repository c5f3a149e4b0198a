#include <algorithm>

#include "common/generic_head.h"
#include "tests/figures/canvas.h"
#include "tests/figures/figures.h"
#include "tests/figures/sheet.h"

namespace fbs::figures {
namespace {

constexpr double kPxPerEyeDistance = 150;
constexpr double kMargin = 0.15;  // eye distances
const cv::Scalar kPaper(255, 255, 255), kLine(120, 85, 40), kVertex(40, 40, 200);

/// @param across  axis of the head that runs from left to right: 0 from the front, 2 from the side
Panel head_view(int across, std::string caption) {
  std::vector<glm::dvec2> points;
  for (const HeadVertex& v : generic_head().vertices)
    points.push_back(glm::dvec2(v.position[across], v.position.y) / (1.0 * kUnitsPerEyeDistance));
  const auto [x0, x1] = std::ranges::minmax(points, {}, &glm::dvec2::x);
  const auto [y0, y1] = std::ranges::minmax(points, {}, &glm::dvec2::y);
  const cv::Rect2d part(x0.x - kMargin, y0.y - kMargin, x1.x - x0.x + 2 * kMargin, y1.y - y0.y + 2 * kMargin);
  Canvas canvas(part, static_cast<int>(part.width * kPxPerEyeDistance), kPaper);
  canvas.wire_frame(points, kLine);
  canvas.dots(points, kVertex, 2.2);
  return {canvas.image(), std::move(caption)};
}

}  // namespace

cv::Mat3b wire_frame_figure() {
  return sheet({{head_view(0, "(a) front"), head_view(2, "(b) side")}});
}

}  // namespace fbs::figures
