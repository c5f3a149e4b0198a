// A triangle made ready for its rows: edges and gradients. SPEC 10.5 to 10.7. Integers only.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <utility>

namespace fbs {

/// A corner on the screen, 1/64 luma pixel from the top left corner of the picture (the centre of the first
/// pixel is at 32, 32).
struct ScreenVertex {
  glm::ivec2 at;
  std::int32_t depth = 0;  ///< larger is farther; any unit
};
using ScreenTriangle = std::array<ScreenVertex, 3>;

enum class PlaneScale : std::uint8_t { kLuma = 6, kChroma = 7 };  ///< log2 of positions per sample

/// Samples [x0, x1) x [y0, y1) of a plane.
struct SampleArea {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  [[nodiscard]] bool empty() const { return x0 >= x1 || y0 >= y1; }
};

/// No limit: holds the samples of every picture.
inline constexpr SampleArea kAllSamples{-(1 << 24), -(1 << 24), 1 << 24, 1 << 24};

inline constexpr int kGradientOneLog2 = 16;

/// Gradients per sample are clamped to +- this; only slivers reach it.
inline constexpr std::int64_t kMaxGradient = std::int64_t{1} << 30;

/// A quantity that is linear over a triangle, Q16.
struct Gradient {
  std::int64_t at_zero = 0;     ///< at the centre of sample 0 of row 0
  std::int64_t dx = 0, dy = 0;  ///< per sample

  [[nodiscard]] std::int64_t at(std::int64_t column, std::int64_t row) const {
    return at_zero + dx * column + dy * row;
  }
  /// Least and greatest value in an area, which is not empty.
  [[nodiscard]] std::pair<std::int64_t, std::int64_t> range(const SampleArea& area) const {
    const auto [left, right] = std::minmax({dx * area.x0, dx * (area.x1 - 1)});
    const auto [top, bottom] = std::minmax({dy * area.y0, dy * (area.y1 - 1)});
    return {at_zero + left + top, at_zero + right + bottom};
  }
  /// Whether it cannot have been clamped.
  [[nodiscard]] bool exact() const {
    return dx > -kMaxGradient && dx < kMaxGradient && dy > -kMaxGradient && dy < kMaxGradient;
  }
};

/// One edge as a half plane: a * column + b * row + c >= 0 holds for samples whose centre lies inside or on a
/// top or left edge.
struct Edge {
  std::int64_t a, b, c;
  /// @param from, to  1/64 luma pixel, clockwise  @param position_bits  log2 of positions per sample
  Edge(glm::ivec2 from, glm::ivec2 to, int position_bits);
};

/// Edges and gradients of a triangle in the planes of one scale.
class TriangleSetup {
 public:
  /// @param area  the samples that may be drawn
  TriangleSetup(const ScreenTriangle& triangle, PlaneScale scale, const SampleArea& area = kAllSamples);

  /// Whether the triangle is clockwise in the picture; only then has it edges and gradients.
  [[nodiscard]] bool faces_viewer() const { return area_ > 0; }

  /// @param value       at the corners, in units of which `1 << value_bits` make 1
  /// @param value_bits  0..16
  [[nodiscard]] Gradient gradient(const std::array<std::int32_t, 3>& value, int value_bits) const;

  /// The samples of the area that it may cover; empty when there are none.
  [[nodiscard]] const SampleArea& box() const { return box_; }
  [[nodiscard]] const std::array<Edge, 3>& edges() const { return edges_; }
  [[nodiscard]] int position_bits() const { return position_bits_; }

 private:
  std::int64_t x_, y_;              // from corner 0 to the centre of sample 0 of row 0
  std::int64_t ax_, ay_, bx_, by_;  // from corner 0 to corners 1 and 2
  std::int64_t area_;               // twice the triangle's, 1/64 pixel squared
  int position_bits_;
  SampleArea box_;
  std::array<Edge, 3> edges_;
};

// Inline: most triangles are a few rows high, and calls cost 3 % of decoding (akiyo_cif).

inline Edge::Edge(glm::ivec2 from, glm::ivec2 to, int position_bits) {
  const std::int64_t by_x = std::int64_t{from.y} - to.y, by_y = std::int64_t{to.x} - from.x;
  const bool left = by_x > 0;              // the edge goes up: the inside is to its right
  const bool top = by_x == 0 && by_y > 0;  // the edge goes right: the inside is below
  const std::int64_t sample = std::int64_t{1} << position_bits, centre = sample / 2;
  a = by_x * sample;
  b = by_y * sample;
  c = by_x * (centre - from.x) + by_y * (centre - from.y) - (left || top ? 0 : 1);
}

inline TriangleSetup::TriangleSetup(const ScreenTriangle& t, PlaneScale scale, const SampleArea& area)
    : ax_(t[1].at.x - t[0].at.x),
      ay_(t[1].at.y - t[0].at.y),
      bx_(t[2].at.x - t[0].at.x),
      by_(t[2].at.y - t[0].at.y),
      area_(ax_ * by_ - ay_ * bx_),
      position_bits_(static_cast<int>(scale)),
      edges_{Edge(t[0].at, t[1].at, position_bits_), Edge(t[1].at, t[2].at, position_bits_),
             Edge(t[2].at, t[0].at, position_bits_)} {
  const int half = 1 << (position_bits_ - 1);
  x_ = std::int64_t{half} - t[0].at.x;
  y_ = std::int64_t{half} - t[0].at.y;
  const auto [left, right] = std::minmax({t[0].at.x, t[1].at.x, t[2].at.x});
  const auto [top, bottom] = std::minmax({t[0].at.y, t[1].at.y, t[2].at.y});
  const auto sample = [&](int position) { return (position - half) >> position_bits_; };
  box_ = {std::max(area.x0, sample(left)), std::max(area.y0, sample(top)),
          std::min(area.x1, sample(right) + 1), std::min(area.y1, sample(bottom) + 1)};
}

inline Gradient TriangleSetup::gradient(const std::array<std::int32_t, 3>& value, int value_bits) const {
  const std::int64_t va = std::int64_t{value[1]} - value[0], vb = std::int64_t{value[2]} - value[0];
  const auto per_sample = [&](std::int64_t per_area) {
    const int to_q16 = kGradientOneLog2 - value_bits + position_bits_;
    return std::clamp(per_area * (std::int64_t{1} << to_q16) / area_, -kMaxGradient, kMaxGradient);
  };
  const std::int64_t at_corner =
      std::int64_t{value[0]} * (std::int64_t{1} << (kGradientOneLog2 - value_bits));
  const std::int64_t dx = per_sample(va * by_ - vb * ay_), dy = per_sample(vb * ax_ - va * bx_);
  return {at_corner + ((dx * x_ + dy * y_) >> position_bits_), dx, dy};
}

/// Whether the triangle faces the viewer (clockwise in the picture).
[[nodiscard]] bool faces_viewer(const ScreenTriangle& triangle);

}  // namespace fbs
