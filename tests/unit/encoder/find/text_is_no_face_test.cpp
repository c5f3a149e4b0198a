#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>
#include <string>

#include "encoder/find/face_finder.h"

namespace fbs {
namespace {

/// Lines of words that nobody reads.
Picture slide(std::mt19937& random) {
  const auto any = [&random](int from, int to) {
    return std::uniform_int_distribution<int>(from, to)(random);
  };
  Picture out(352, 288);
  cv::Mat luma(out.height(), out.width(), CV_8UC1, out.y.samples.data());
  const bool dark = any(0, 1) == 0;
  luma.setTo(dark ? 40 : 225);
  const int size = any(4, 12), pitch = size * any(30, 45) / 10;
  for (int y = pitch; y < out.height(); y += pitch) {
    std::string line;
    for (int words = any(1, 4); words > 0; --words) {
      for (int letters = any(1, 9); letters > 0; --letters) line += static_cast<char>(any('a', 'z'));
      line += ' ';
    }
    cv::putText(luma, line, {any(5, 60), y}, any(cv::FONT_HERSHEY_SIMPLEX, cv::FONT_HERSHEY_TRIPLEX),
                size / 10.0, cv::Scalar(dark ? 220 : 30), any(1, 2), cv::LINE_AA);
  }
  return out;
}

// Two letters over one look a little like eyes and a mouth, and slides are cut into talks.
TEST(FaceFinder, FindsNothingInText) {
  const auto finder = FaceFinder::create();
  ASSERT_TRUE(finder);
  std::mt19937 random(1);
  for (int n = 0; n < 40; ++n) EXPECT_TRUE(finder->find(slide(random)).empty()) << n;
}

}  // namespace
}  // namespace fbs
