#include "encoder/track/snake/snake_filters.h"

#include <gtest/gtest.h>

#include "encoder/track/snake/feature_patch.h"

namespace fbs {
namespace {

cv::Mat1f ramp(float dx, float dy) {
  cv::Mat1f out(20, 24);
  for (int y = 0; y < out.rows; ++y)
    for (int x = 0; x < out.cols; ++x) out(y, x) = dx * static_cast<float>(x) + dy * static_cast<float>(y);
  return out;
}

TEST(Slopes, AreThoseOfARampPerSnakeUnit) {
  cv::Mat1f by_x, by_y;
  slopes(ramp(2, -1), 1, by_x, by_y);
  EXPECT_FLOAT_EQ(by_x(10, 10), static_cast<float>(2 * kPatchPxPerUnit));
  EXPECT_FLOAT_EQ(by_y(10, 10), static_cast<float>(-kPatchPxPerUnit));
  slopes(ramp(2, -1), -1, by_x, by_y);
  EXPECT_FLOAT_EQ(by_x(10, 10), static_cast<float>(-2 * kPatchPxPerUnit));
}

TEST(Slopes, AreNoneAcrossTheBorder) {
  cv::Mat1f by_x, by_y;
  slopes(ramp(2, -1), 1, by_x, by_y);
  EXPECT_EQ(by_x(10, 0), 0);
  EXPECT_EQ(by_x(10, 23), 0);
  EXPECT_EQ(by_y(0, 10), 0);
  EXPECT_EQ(by_y(19, 10), 0);
}

TEST(Smooth, KeepsTheMeanAndSpreadsAPoint) {
  cv::Mat1f point = cv::Mat1f::zeros(40, 40), out;
  point(20, 20) = 100;
  smooth(point, out, 1);
  EXPECT_NEAR(cv::sum(out)[0], 100, 1e-3);
  const double sigma = kPatchPxPerUnit;
  EXPECT_NEAR(out(20, 23) / out(20, 20), std::exp(-9 / (2 * sigma * sigma)), 0.02);
  smooth(point, point, 1);
  EXPECT_EQ(cv::norm(point, out, cv::NORM_INF), 0) << "in place";
}

}  // namespace
}  // namespace fbs
