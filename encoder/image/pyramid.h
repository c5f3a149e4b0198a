// Pictures at several sizes: the reduced luma that the analysis works on, and its halvings.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <opencv2/imgproc.hpp>

#include "encoder/image/planes.h"

namespace fbs {

/// [0] is the finest level, each next one half of it (Gaussian 5 x 5, then every other sample).
template <std::size_t kLevels>
using Pyramid = std::array<cv::Mat, kLevels>;

/// @param finest  becomes level 0, not copied
template <std::size_t kLevels>
[[nodiscard]] Pyramid<kLevels> make_pyramid(const cv::Mat& finest) {
  Pyramid<kLevels> levels;
  levels[0] = finest;
  for (std::size_t l = 1; l < kLevels; ++l) cv::pyrDown(levels[l - 1], levels[l]);
  return levels;
}

/// Pixels of level 0 per pixel of a level.
[[nodiscard]] constexpr double level_scale(int level) {
  return 1 << level;
}

/// Position on a level of a position on level 0. Pixel centres are whole numbers in both: pyrDown keeps the
/// samples at even positions in place.
[[nodiscard]] inline glm::dvec2 on_level(glm::dvec2 finest, int level) {
  constexpr double kShare[] = {1, 0.5, 0.25, 0.125};  // products are faster, and as exact
  return finest * kShare[level];
}

/// The least whole factor that reduces a picture's longer side to `long_side` samples or fewer.
[[nodiscard]] inline int reduction_factor(int width, int height, int long_side) {
  return (std::max(width, height) + long_side - 1) / long_side;
}

/// A plane at 1/factor of its size, each sample the mean of those it replaces; never a view.
[[nodiscard]] cv::Mat reduced(const Plane& plane, int factor);

/// A picture at another size, at least a quarter of its own, without aliasing. Averages over areas, after
/// interpolation to twice the size: OpenCV takes three times as long for means over fractions of samples.
[[nodiscard]] inline cv::Mat resized(const cv::Mat& picture, cv::Size size) {
  cv::Mat out;
  if (size.width >= picture.cols) {
    cv::resize(picture, out, size, 0, 0, cv::INTER_LINEAR);
    return out;
  }
  cv::Mat twice;
  cv::resize(picture, twice, {2 * size.width, 2 * size.height}, 0, 0, cv::INTER_LINEAR);
  cv::resize(twice, out, size, 0, 0, cv::INTER_AREA);
  return out;
}

}  // namespace fbs
