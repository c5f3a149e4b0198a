#include "encoder/image/pyramid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fbs {
namespace {

/// A blob about a position, pixel centres at whole numbers.
cv::Mat1b blob(int width, int height, glm::dvec2 at) {
  cv::Mat1b out(height, width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double d = std::hypot(x - at.x, y - at.y);
      out(y, x) = static_cast<std::uint8_t>(std::lround(250 * std::exp(-d * d / 50)));
    }
  return out;
}

glm::dvec2 centre_of_brightness(const cv::Mat& m) {
  const cv::Moments moments = cv::moments(m);
  return {moments.m10 / moments.m00, moments.m01 / moments.m00};
}

TEST(Pyramid, EachLevelIsHalfOfTheOneBefore) {
  const auto levels = make_pyramid<3>(cv::Mat::zeros(61, 80, CV_8U));
  EXPECT_EQ(levels[0].size(), cv::Size(80, 61));
  EXPECT_EQ(levels[1].size(), cv::Size(40, 31));
  EXPECT_EQ(levels[2].size(), cv::Size(20, 16));
}

TEST(Pyramid, PositionsOfLevelZeroAreFoundInEachLevel) {
  const glm::dvec2 at(41.3, 37.8);
  const auto levels = make_pyramid<3>(blob(80, 80, at));
  for (int l = 0; l < 3; ++l) {
    const glm::dvec2 found = centre_of_brightness(levels[l]), wanted = on_level(at, l);
    EXPECT_NEAR(found.x, wanted.x, 0.1) << l;
    EXPECT_NEAR(found.y, wanted.y, 0.1) << l;
  }
}

TEST(Pyramid, LevelZeroIsNotCopied) {
  const cv::Mat finest = cv::Mat::zeros(8, 8, CV_8U);
  EXPECT_EQ(make_pyramid<2>(finest)[0].data, finest.data);
}

TEST(Reduction, LongerSideFitsAndNoSmallerFactorWould) {
  for (const int side : {64, 256, 257, 512, 1920, 8192}) {
    const int factor = reduction_factor(side, side / 2, 256);
    EXPECT_LE(side, 256 * factor) << side;
    EXPECT_GT(side, 256 * (factor - 1)) << side;
    EXPECT_EQ(reduction_factor(side / 2, side, 256), factor);
  }
}

TEST(Reduction, SamplesAreThoseOfOpenCv) {
  for (const int factor : {2, 3, 4, 6, 10, 20}) {
    Plane plane(factor * 16, factor * 9);
    cv::Mat1b samples = view(plane), expected;
    cv::RNG(static_cast<std::uint64_t>(factor)).fill(samples, cv::RNG::UNIFORM, 0, 256);
    cv::resize(samples, expected, {16, 9}, 0, 0, cv::INTER_AREA);
    EXPECT_EQ(cv::norm(reduced(plane, factor), expected, cv::NORM_INF), 0) << factor;
  }
}

TEST(Reduction, SamplesAreMeans) {
  Plane plane(6, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 6; ++x) plane.row(y)[x] = static_cast<std::uint8_t>(10 * x + 40 * y);
  const cv::Mat1b half = reduced(plane, 2);
  ASSERT_EQ(half.size(), cv::Size(3, 2));
  EXPECT_EQ(half(0, 0), (0 + 10 + 40 + 50) / 4);
  EXPECT_EQ(half(1, 2), (120 + 130 + 160 + 170) / 4);
}

TEST(Reduction, OwnsItsSamplesEvenAtFullSize) {
  Plane plane(4, 4, 7);
  const cv::Mat same = reduced(plane, 1);
  plane.row(0)[0] = 9;
  EXPECT_EQ(same.at<std::uint8_t>(0, 0), 7);
}

}  // namespace
}  // namespace fbs
