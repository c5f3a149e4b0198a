// Bilinear interpolation. Positions count from the centre of the first sample.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/vec2.hpp>
#include <opencv2/core.hpp>
#include <type_traits>

namespace fbs {

/// Between the samples at (column, row) and (column + 1, row + 1), by the share `fraction` of the latter.
template <class Real>
struct BilinearCell {
  int column, row;
  glm::vec<2, Real> fraction;

  explicit BilinearCell(glm::vec<2, Real> at)
      : column(static_cast<int>(at.x)),
        row(static_cast<int>(at.y)),
        fraction(at.x - static_cast<Real>(column), at.y - static_cast<Real>(row)) {}
};

/// Border policy "refuse": whether four samples surround a position.
[[nodiscard]] inline bool has_cell(const cv::Mat& picture, glm::dvec2 at) {
  return at.x >= 0 && at.y >= 0 && at.x < picture.cols - 1 && at.y < picture.rows - 1;
}

/// Border policy "clamp": the border's samples are repeated.
/// @param inset  how far before the border positions end, a little more than 1: room for the cell's far side
template <class Real>
[[nodiscard]] glm::vec<2, Real> clamped(const cv::Mat& picture, glm::vec<2, Real> at, Real inset) {
  return {std::clamp(at.x, Real(0), static_cast<Real>(picture.cols) - inset),
          std::clamp(at.y, Real(0), static_cast<Real>(picture.rows) - inset)};
}

/// Interpolates a and b with shares (1 - f) and f. In float by one product, for speed; in double by two. The
/// results differ in their last bit, and streams depend on it.
template <class Real>
[[nodiscard]] constexpr Real mix(Real a, Real b, Real f) {
  if constexpr (std::is_same_v<Real, float>)
    return a + (b - a) * f;
  else
    return a * (1 - f) + b * f;
}

/// The value of a picture of type T in a cell inside it: along the rows first.
template <class T, class Real>
[[nodiscard]] Real bilinear(const cv::Mat& picture, const BilinearCell<Real>& cell) {
  const T *a = picture.ptr<T>(cell.row) + cell.column, *b = picture.ptr<T>(cell.row + 1) + cell.column;
  const Real above = mix(static_cast<Real>(a[0]), static_cast<Real>(a[1]), cell.fraction.x);
  const Real below = mix(static_cast<Real>(b[0]), static_cast<Real>(b[1]), cell.fraction.x);
  return mix(above, below, cell.fraction.y);
}

/// Bilinear value and central-difference slope of an 8-bit picture.
struct Sample {
  float value = 0, dx = 0, dy = 0;
};

/// Columns first, unlike bilinear(): value and slopes share the resulting row.
/// @return false within two pixels of the border and outside
template <class Real>  // float or double
[[nodiscard]] inline bool sample_with_slope(const cv::Mat& picture, glm::vec<2, Real> at, Sample& out) {
  constexpr auto kBorder = static_cast<Real>(2.001);
  if (!(at.x >= 1 && at.y >= 1 && at.x < static_cast<Real>(picture.cols) - kBorder &&
        at.y < static_cast<Real>(picture.rows) - kBorder))
    return false;
  const BilinearCell<Real> cell(at);
  const glm::vec2 f(cell.fraction);
  const std::size_t stride = picture.step.p[0];
  const std::uint8_t* r1 = picture.data + static_cast<std::size_t>(cell.row) * stride + cell.column;
  const std::uint8_t *r0 = r1 - stride, *r2 = r1 + stride, *r3 = r2 + stride;
  // Rows 1 and 2 are combined into a row at the height of `at`, whose four samples give value and slope.
  alignas(16) float row[4], down[4];
  for (int k = 0; k < 4; ++k) row[k] = mix(static_cast<float>(r1[k - 1]), static_cast<float>(r2[k - 1]), f.y);
  out.value = mix(row[1], row[2], f.x);
  out.dx = 0.5F * mix(row[2] - row[0], row[3] - row[1], f.x);
  for (int k = 0; k < 2; ++k)
    down[k] = static_cast<float>(r2[k] - r0[k]) * (1 - f.y) + static_cast<float>(r3[k] - r1[k]) * f.y;
  out.dy = 0.5F * mix(down[0], down[1], f.x);
  return true;
}

}  // namespace fbs
