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

/// @param from_side  from the subject's left, so that the nose points to the left
Panel head_view(bool from_side, std::string caption) {
  std::vector<glm::dvec3> head;
  for (const HeadVertex& v : generic_head().vertices) {
    const glm::dvec3 p = glm::dvec3(v.position) / (1.0 * kUnitsPerEyeDistance);
    head.push_back(from_side ? glm::dvec3(p.z, p.y, -p.x) : p);
  }
  const std::vector<glm::dvec2> points(head.begin(), head.end());
  const auto [x0, x1] = std::ranges::minmax(points, {}, &glm::dvec2::x);
  const auto [y0, y1] = std::ranges::minmax(points, {}, &glm::dvec2::y);
  const cv::Rect2d part(x0.x - kMargin, y0.y - kMargin, x1.x - x0.x + 2 * kMargin, y1.y - y0.y + 2 * kMargin);
  Canvas canvas(part, static_cast<int>(part.width * kPxPerEyeDistance), kPaper);
  canvas.wire_frame(generic_head(), head, kLine);
  canvas.dots(visible_vertices(generic_head(), head), kVertex, 2.2);
  return {canvas.image(), std::move(caption)};
}

}  // namespace

cv::Mat3b wire_frame_figure() {
  return sheet({{head_view(false, "(a) front"), head_view(true, "(b) side")}});
}

}  // namespace fbs::figures
