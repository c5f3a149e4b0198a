#include "encoder/landmarks/orientation_maps.h"

#include <cmath>
#include <numbers>
#include <numeric>
#include <opencv2/imgproc.hpp>

namespace fbs {

cv::Mat orientation_maps(const cv::Mat1f& luma, float sigma) {
  cv::Mat1f dx, dy, length, angle;
  cv::Sobel(luma, dx, CV_32F, 1, 0, 1);
  cv::Sobel(luma, dy, CV_32F, 0, 1, 1);
  cv::cartToPolar(dx, dy, length, angle);
  cv::Mat maps(luma.size(), CV_32FC(kOrientations), cv::Scalar::all(0));
  for (int y = 0; y < luma.rows; ++y)
    for (int x = 0; x < luma.cols; ++x) {
      // Each gradient is split between the two orientations next to its own.
      const float at = angle(y, x) * (kOrientations / (2 * std::numbers::pi_v<float>));
      const int before = static_cast<int>(at);
      const float share = at - static_cast<float>(before);
      auto& histogram = maps.at<Histogram>(y, x);
      histogram[before % kOrientations] += length(y, x) * (1 - share);
      histogram[(before + 1) % kOrientations] += length(y, x) * share;
    }
  // To three sigma: OpenCV's own four take a quarter longer.
  const int side = 2 * static_cast<int>(std::ceil(3 * sigma)) + 1;
  cv::GaussianBlur(maps, maps, {side, side}, sigma);
  return maps;
}

void scale_to_unit_length(std::span<float> histograms) {
  const float squares = std::accumulate(histograms.begin(), histograms.end(), kNoiseGradient * kNoiseGradient,
                                        [](float sum, float value) { return sum + value * value; });
  const float factor = 1 / std::sqrt(squares);
  for (float& value : histograms) value *= factor;
}

}  // namespace fbs
