#include "training/textures.h"

#include <opencv2/imgproc.hpp>
#include <random>

namespace fbs {

std::vector<cv::Mat1b> draw_textures(int count) {
  constexpr int kSide = 192;
  constexpr int kFinest = 1, kCoarsest = 48;  ///< grains, pixels
  std::mt19937 random(7);
  const auto any = [&random](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  };
  std::vector<cv::Mat1b> out(static_cast<std::size_t>(count));
  for (cv::Mat1b& texture : out) {
    cv::Mat1f sum(kSide, kSide, static_cast<float>(any(60, 200)));
    for (int grain = kFinest; grain <= kCoarsest; grain *= 2) {
      if (any(0, 1) < 0.4) continue;
      cv::Mat1f noise(kSide / grain + 1, kSide / grain + 1), grown;
      cv::RNG(random()).fill(noise, cv::RNG::NORMAL, 0, any(5, 60));
      cv::resize(noise, grown, sum.size(), 0, 0, cv::INTER_CUBIC);
      sum += grown;
    }
    sum.convertTo(texture, CV_8U);
  }
  return out;
}

}  // namespace fbs
