// Pictures between their samples.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <opencv2/core.hpp>

namespace fbs {

/// Bilinear value and central-difference slope of an 8-bit picture.
struct Sample {
  float value = 0, dx = 0, dy = 0;
};

/// @return false within two pixels of the border and outside
template <class Real>  // float or double
[[nodiscard]] inline bool sample_with_slope(const cv::Mat& picture, glm::vec<2, Real> at, Sample& out) {
  constexpr auto kBorder = static_cast<Real>(2.001);
  if (!(at.x >= 1 && at.y >= 1 && at.x < static_cast<Real>(picture.cols) - kBorder &&
        at.y < static_cast<Real>(picture.rows) - kBorder))
    return false;
  const int i = static_cast<int>(at.x), j = static_cast<int>(at.y);
  const auto fx = static_cast<float>(at.x - static_cast<Real>(i));
  const auto fy = static_cast<float>(at.y - static_cast<Real>(j));
  const std::size_t stride = picture.step.p[0];
  const std::uint8_t* r1 = picture.data + static_cast<std::size_t>(j) * stride + i;
  const std::uint8_t *r0 = r1 - stride, *r2 = r1 + stride, *r3 = r2 + stride;
  // Rows 1 and 2 meet in a row at the height of `at`, whose value and slope follow from four samples.
  alignas(16) float row[4], down[4];
  for (int k = 0; k < 4; ++k) {
    const auto above = static_cast<float>(r1[k - 1]), below = static_cast<float>(r2[k - 1]);
    row[k] = above + (below - above) * fy;
  }
  out.value = row[1] + (row[2] - row[1]) * fx;
  const float left = row[2] - row[0], right = row[3] - row[1];
  out.dx = 0.5F * (left + (right - left) * fx);
  for (int k = 0; k < 2; ++k)
    down[k] = static_cast<float>(r2[k] - r0[k]) * (1 - fy) + static_cast<float>(r3[k] - r1[k]) * fy;
  out.dy = 0.5F * (down[0] + (down[1] - down[0]) * fx);
  return true;
}

}  // namespace fbs
