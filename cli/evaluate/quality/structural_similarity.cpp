#include "cli/evaluate/quality/structural_similarity.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <opencv2/imgproc.hpp>

namespace fbs::cli {
namespace {

constexpr int kWindow = 11;  // samples
constexpr double kSigma = 1.5;
constexpr double kC1 = 6.5025, kC2 = 58.5225;                           // (0.01 * 255)^2, (0.03 * 255)^2
constexpr std::array kWeights{0.0448, 0.2856, 0.3001, 0.2363, 0.1333};  // finest scale first

cv::Mat as_float(const Plane& plane) {
  cv::Mat out(plane.height, plane.width, CV_32F);
  for (int y = 0; y < plane.height; ++y) std::copy_n(plane.row(y), plane.width, out.ptr<float>(y));
  return out;
}

cv::Mat blurred(const cv::Mat& image) {
  cv::Mat out;
  cv::GaussianBlur(image, out, {kWindow, kWindow}, kSigma, kSigma, cv::BORDER_REFLECT_101);
  return out;
}

/// Means over the plane at one scale.
struct Terms {
  double similarity = 0;          ///< luminance, contrast and structure
  double contrast_structure = 0;  ///< without luminance
};

Terms terms_of(const cv::Mat& a, const cv::Mat& b) {
  const cv::Mat ma = blurred(a), mb = blurred(b);
  const cv::Mat aa = blurred(a.mul(a)), bb = blurred(b.mul(b)), ab = blurred(a.mul(b));
  Terms sum;
  for (int y = 0; y < a.rows; ++y) {
    for (int x = 0; x < a.cols; ++x) {
      const auto at = [&](const cv::Mat& m) { return static_cast<double>(m.at<float>(y, x)); };
      const double p = at(ma), q = at(mb);
      const double contrast_structure =
          (2 * (at(ab) - p * q) + kC2) / (at(aa) - p * p + at(bb) - q * q + kC2);
      sum.contrast_structure += contrast_structure;
      sum.similarity += contrast_structure * (2 * p * q + kC1) / (p * p + q * q + kC1);
    }
  }
  const auto count = static_cast<double>(a.total());
  return {sum.similarity / count, sum.contrast_structure / count};
}

cv::Mat halved(const cv::Mat& image) {
  cv::Mat out;
  const cv::Rect whole_blocks(0, 0, image.cols / 2 * 2, image.rows / 2 * 2);
  cv::resize(image(whole_blocks), out, {}, 0.5, 0.5, cv::INTER_AREA);
  return out;
}

}  // namespace

int ms_ssim_scales(int width, int height) {
  int scales = 1;
  for (int side = std::min(width, height) / 2; side >= kWindow; side /= 2) ++scales;
  return std::min(scales, static_cast<int>(kWeights.size()));
}

StructuralSimilarity structural_similarity(const Plane& a, const Plane& b) {
  assert(a.width == b.width && a.height == b.height && a.width > 0 && a.height > 0);
  cv::Mat p = as_float(a), q = as_float(b);
  const auto scales = static_cast<std::size_t>(ms_ssim_scales(a.width, a.height));
  const double weight_sum = std::accumulate(kWeights.begin(), kWeights.begin() + scales, 0.0);
  StructuralSimilarity out{0, 1};
  for (std::size_t scale = 0; scale < scales; ++scale) {
    if (scale > 0) {
      p = halved(p);
      q = halved(q);
    }
    const Terms terms = terms_of(p, q);
    if (scale == 0) out.ssim = terms.similarity;
    // A negative mean, of pictures that are each other's negative, has no real power.
    const double term = scale + 1 == scales ? terms.similarity : terms.contrast_structure;
    out.ms_ssim *= std::pow(std::max(term, 0.0), kWeights.at(scale) / weight_sum);
  }
  return out;
}

}  // namespace fbs::cli
