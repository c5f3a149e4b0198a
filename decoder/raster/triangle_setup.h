// A triangle prepared for rasterising: edges and gradients. SPEC 10.5 to 10.7. Integers only.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

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
  [[nodiscard]] int count() const { return empty() ? 0 : (x1 - x0) * (y1 - y0); }
};

[[nodiscard]] inline SampleArea intersection(const SampleArea& a, const SampleArea& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

/// Position of a sample's centre relative to corner 0 of a triangle, 1/64 luma pixel.
struct FromCorner {
  std::int64_t x, y;
};

inline constexpr int kGradientOneLog2 = 16;

/// Gradients per sample are clamped to +- this; only slivers reach it.
inline constexpr std::int64_t kMaxGradient = std::int64_t{1} << 30;

/// A quantity that is linear over a triangle, Q16.
struct Gradient {
  std::int64_t origin = 0;      ///< at corner 0
  std::int64_t dx = 0, dy = 0;  ///< per sample

  /// @param position_bits  log2 of positions per sample
  [[nodiscard]] std::int64_t at(FromCorner p, int position_bits) const {
    return origin + ((dx * p.x + dy * p.y) >> position_bits);
  }
  /// Whether it was certainly not clamped.
  [[nodiscard]] bool exact() const {
    return dx > -kMaxGradient && dx < kMaxGradient && dy > -kMaxGradient && dy < kMaxGradient;
  }
};

/// A quantity at the samples of a plane.
struct LinearPlane {
  std::int64_t first = 0;       ///< at sample (0, 0)
  std::int64_t dx = 0, dy = 0;  ///< per sample
  [[nodiscard]] std::int64_t at(int x, int y) const { return first + dx * x + dy * y; }
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
  TriangleSetup(const ScreenTriangle& triangle, PlaneScale scale);

  /// Whether the triangle is clockwise in the picture; only then does it have edges and gradients.
  [[nodiscard]] bool faces_viewer() const { return area_ > 0; }

  /// @param value       at the corners, in units of 1 / (1 << value_bits)
  /// @param value_bits  0..16
  [[nodiscard]] Gradient gradient(const std::array<std::int32_t, 3>& value, int value_bits) const;

  /// A gradient over the plane.
  [[nodiscard]] LinearPlane over_plane(const Gradient& g) const {
    return {g.at(first_sample_, position_bits_), g.dx, g.dy};
  }

  /// First and last row of the plane that the triangle may cover; none when last < first.
  [[nodiscard]] int first_row() const { return first_row_; }
  [[nodiscard]] int last_row() const { return last_row_; }
  [[nodiscard]] const std::array<Edge, 3>& edges() const { return edges_; }
  [[nodiscard]] int position_bits() const { return position_bits_; }
  [[nodiscard]] FromCorner from_corner(int column, int row) const {
    return {(std::int64_t{column} << position_bits_) + first_sample_.x,
            (std::int64_t{row} << position_bits_) + first_sample_.y};
  }

 private:
  FromCorner first_sample_;         // centre of sample 0 of row 0
  std::int64_t ax_, ay_, bx_, by_;  // from corner 0 to corners 1 and 2
  std::int64_t area_;               // twice the triangle's, 1/64 pixel squared
  int position_bits_;
  int first_row_, last_row_;
  std::array<Edge, 3> edges_;
};

// Inline: most triangles are a few rows high, and calls cost 3 % of decoding (akiyo_cif).

inline Edge::Edge(glm::ivec2 from, glm::ivec2 to, int position_bits) {
  const std::int64_t by_x = std::int64_t{from.y} - to.y, by_y = std::int64_t{to.x} - from.x;
  const bool left = by_x > 0;              // the edge goes up: the inside is to its right
  const bool top = by_x == 0 && by_y > 0;  // the edge goes right: the inside is below
  const std::int64_t centre = std::int64_t{1} << (position_bits - 1);
  const std::int64_t at_first = by_x * (centre - from.x) + by_y * (centre - from.y) - (left || top ? 0 : 1);
  a = by_x;
  b = by_y;
  c = at_first >> position_bits;  // the rest of the sum is a multiple of what this leaves out
}

inline TriangleSetup::TriangleSetup(const ScreenTriangle& t, PlaneScale scale)
    : ax_(t[1].at.x - t[0].at.x),
      ay_(t[1].at.y - t[0].at.y),
      bx_(t[2].at.x - t[0].at.x),
      by_(t[2].at.y - t[0].at.y),
      area_(ax_ * by_ - ay_ * bx_),
      position_bits_(static_cast<int>(scale)),
      edges_{Edge(t[0].at, t[1].at, position_bits_), Edge(t[1].at, t[2].at, position_bits_),
             Edge(t[2].at, t[0].at, position_bits_)} {
  const int half = 1 << (position_bits_ - 1);
  first_sample_ = {std::int64_t{half} - t[0].at.x, std::int64_t{half} - t[0].at.y};
  const auto [low, high] = std::minmax({t[0].at.y, t[1].at.y, t[2].at.y});
  first_row_ = (low - half) >> position_bits_;
  last_row_ = (high - half) >> position_bits_;
}

inline Gradient TriangleSetup::gradient(const std::array<std::int32_t, 3>& value, int value_bits) const {
  const std::int64_t va = std::int64_t{value[1]} - value[0], vb = std::int64_t{value[2]} - value[0];
  if (va == 0 && vb == 0)
    return {std::int64_t{value[0]} * (std::int64_t{1} << (kGradientOneLog2 - value_bits))};
  const auto per_sample = [&](std::int64_t per_area) {
    const int to_q16 = kGradientOneLog2 - value_bits + position_bits_;
    return std::clamp(per_area * (std::int64_t{1} << to_q16) / area_, -kMaxGradient, kMaxGradient);
  };
  return {std::int64_t{value[0]} * (std::int64_t{1} << (kGradientOneLog2 - value_bits)),
          per_sample(va * by_ - vb * ay_), per_sample(vb * ax_ - va * bx_)};
}

/// Whether the triangle faces the viewer (clockwise in the picture).
[[nodiscard]] bool faces_viewer(const ScreenTriangle& triangle);

}  // namespace fbs
