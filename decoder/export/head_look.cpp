#include "decoder/export/head_look.h"

#include <algorithm>

#include "decoder/head/head_deformation.h"
#include "decoder/head/head_projection.h"
#include "decoder/head/mouth_interior.h"

namespace fbs {
namespace {

constexpr int kMargin = 2;  ///< samples; bilinear filters read one farther

}  // namespace

TextureArea texture_area(const RecordedHead& head) {
  glm::ivec2 low{INT32_MAX}, high{INT32_MIN};
  for (const glm::ivec3& p : project_vertices(head.geometry, head.seen)) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const auto within = [](std::int32_t screen, int margin, int size) {
    return std::clamp((screen >> kScreenOneLog2) + margin, 0, size);
  };
  const int width = head.pattern.width(), height = head.pattern.height();
  const int left = std::min(within(low.x, -kMargin, width), width - 1);
  const int top = std::min(within(low.y, -kMargin, height), height - 1);
  return {left, top, std::max(within(high.x, kMargin + 1, width) - left, 1),
          std::max(within(high.y, kMargin + 1, height) - top, 1)};
}

std::vector<glm::dvec2> texture_coordinates(const RecordedHead& head, const TextureArea& area) {
  std::vector<glm::dvec2> out;
  constexpr double kPixel = 1 << kScreenOneLog2;
  for (const glm::ivec3& p : project_vertices(head.geometry, head.seen))
    out.emplace_back((p.x / kPixel - area.left) / area.width, (p.y / kPixel - area.top) / area.height);
  return out;
}

std::array<YuvColour, kInteriorCount> mouth_colours(const RecordedHead& head) {
  const std::int32_t gap_seen = mouth_gap(head.geometry, head.seen);
  std::array<std::int64_t, kInteriorCount> sum{};
  std::int64_t weight = 0;
  for (const RecordedState& s : head.states) {
    const std::int32_t opacity = interior_opacity(mouth_gap(head.geometry, s.state), gap_seen);
    weight += opacity;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += std::int64_t{opacity} * s.state.interior[i];
  }
  std::array<std::int32_t, kInteriorCount> added{};
  if (weight > 0)
    for (std::size_t i = 0; i < sum.size(); ++i) added[i] = static_cast<std::int32_t>(sum[i] / weight);
  const auto planes = interior_colours(head.mouth, added);
  std::array<YuvColour, kInteriorCount> out;
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {planes[0][i], planes[1][i], planes[2][i]};
  return out;
}

bool pattern_shows_mouth(const RecordedHead& head) {
  return mouth_gap(head.geometry, head.seen) >= kInteriorOpaque;
}

HeadTriangles head_triangles(const RecordedHead& head) {
  HeadTriangles out;
  const bool separate = !pattern_shows_mouth(head);
  const WireFrame& frame = head.geometry.wire_frame();
  for (const HeadTriangle& t : frame.triangles) {
    auto& corners = separate && is_mouth(frame, t) ? out.mouth : out.face;
    corners.insert(corners.end(), {t[0], t[2], t[1]});
  }
  return out;
}

}  // namespace fbs
