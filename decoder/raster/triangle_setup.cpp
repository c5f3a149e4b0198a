#include "decoder/raster/triangle_setup.h"

#include <algorithm>

namespace fbs {
namespace {

constexpr int kGradientOneLog2 = 16;

std::int64_t twice_area(const ScreenTriangle& t) {
  const std::int64_t ax = t[1].at.x - t[0].at.x, ay = t[1].at.y - t[0].at.y;
  const std::int64_t bx = t[2].at.x - t[0].at.x, by = t[2].at.y - t[0].at.y;
  return ax * by - ay * bx;
}

}  // namespace

Edge::Edge(glm::ivec2 from, glm::ivec2 to, int position_bits) {
  const std::int64_t by_x = std::int64_t{from.y} - to.y, by_y = std::int64_t{to.x} - from.x;
  const bool left = by_x > 0;              // the edge goes up: the inside is to its right
  const bool top = by_x == 0 && by_y > 0;  // the edge goes right: the inside is below
  const std::int64_t sample = std::int64_t{1} << position_bits, centre = sample / 2;
  a = by_x * sample;
  b = by_y * sample;
  c = by_x * (centre - from.x) + by_y * (centre - from.y) - (left || top ? 0 : 1);
}

TriangleSetup::TriangleSetup(const ScreenTriangle& t, PlaneScale scale)
    : corner_(t[0].at),
      ax_(t[1].at.x - t[0].at.x),
      ay_(t[1].at.y - t[0].at.y),
      bx_(t[2].at.x - t[0].at.x),
      by_(t[2].at.y - t[0].at.y),
      area_(ax_ * by_ - ay_ * bx_),
      position_bits_(static_cast<int>(scale)),
      edges_{Edge(t[0].at, t[1].at, position_bits_), Edge(t[1].at, t[2].at, position_bits_),
             Edge(t[2].at, t[0].at, position_bits_)} {
  const int half = 1 << (position_bits_ - 1);
  const auto [low, high] = std::minmax({t[0].at.y, t[1].at.y, t[2].at.y});
  first_row_ = (low - half) >> position_bits_;
  last_row_ = (high - half) >> position_bits_;
}

Gradient TriangleSetup::gradient(const std::array<std::int32_t, 3>& value, int value_bits) const {
  const std::int64_t va = std::int64_t{value[1]} - value[0], vb = std::int64_t{value[2]} - value[0];
  const auto per_sample = [&](std::int64_t per_area) {
    const int to_q16 = kGradientOneLog2 - value_bits + position_bits_;
    return std::clamp(per_area * (std::int64_t{1} << to_q16) / area_, -kMaxGradient, kMaxGradient);
  };
  return {std::int64_t{value[0]} * (std::int64_t{1} << (kGradientOneLog2 - value_bits)),
          per_sample(va * by_ - vb * ay_), per_sample(vb * ax_ - va * bx_)};
}

bool faces_viewer(const ScreenTriangle& triangle) {
  return twice_area(triangle) > 0;
}

}  // namespace fbs
