#include "encoder/track/snake/snake_filters.h"

#include <cmath>
#include <map>
#include <mutex>
#include <opencv2/imgproc.hpp>

#include "encoder/track/snake/feature_patch.h"

namespace fbs {
namespace {

/// A Gaussian as a column. Cached: OpenCV takes longer to compute one than to blur with it.
const cv::Mat& gaussian(double sigma_units) {
  static std::map<double, cv::Mat> kept;
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  cv::Mat& kernel = kept[sigma_units];
  if (kernel.empty()) {
    const double sigma = sigma_units * kPatchPxPerUnit;
    kernel = cv::getGaussianKernel(2 * static_cast<int>(std::lround(3 * sigma)) + 1, sigma, CV_32F);
  }
  return kernel;
}

}  // namespace

void smooth(const cv::Mat1f& in, cv::Mat1f& out, double sigma_units) {
  const cv::Mat& kernel = gaussian(sigma_units);
  cv::sepFilter2D(in, out, CV_32F, kernel, kernel);
}

void slopes(const cv::Mat1f& values, float sign, cv::Mat1f& by_x, cv::Mat1f& by_y) {
  const float half = sign * static_cast<float>(0.5 * kPatchPxPerUnit);
  const int w = values.cols, h = values.rows;
  by_x.create(values.size());
  by_y.create(values.size());
  for (int y = 0; y < h; ++y) {
    // The border is mirrored, as in OpenCV's filters.
    const float *above = values[y > 0 ? y - 1 : 1], *here = values[y],
                *below = values[y < h - 1 ? y + 1 : h - 2];
    float *dx = by_x[y], *dy = by_y[y];
    for (int x = 1; x < w - 1; ++x) dx[x] = half * (here[x + 1] - here[x - 1]);
    dx[0] = dx[w - 1] = 0;
    for (int x = 0; x < w; ++x) dy[x] = half * (below[x] - above[x]);
  }
}

}  // namespace fbs
