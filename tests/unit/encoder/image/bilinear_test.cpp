#include "encoder/image/bilinear.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

constexpr int kWidth = 24, kHeight = 18;

double plane_at(double x, double y) {
  return 20 + 5 * x + 3 * y;
}

cv::Mat1b plane() {
  cv::Mat1b out(kHeight, kWidth);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) out(y, x) = static_cast<std::uint8_t>(plane_at(x, y));
  return out;
}

TEST(Bilinear, IsExactOnAPlane) {
  const cv::Mat1b bytes = plane();
  cv::Mat1f floats;
  bytes.convertTo(floats, CV_32F);
  for (double y = 0; y < kHeight - 1; y += 0.7) {
    for (double x = 0; x < kWidth - 1; x += 0.6) {
      const glm::dvec2 at(x, y);
      EXPECT_NEAR(bilinear<std::uint8_t>(bytes, BilinearCell(at)), plane_at(x, y), 1e-9);
      EXPECT_NEAR(bilinear<float>(floats, BilinearCell(at)), plane_at(x, y), 1e-9);
      EXPECT_NEAR(bilinear<std::uint8_t>(bytes, BilinearCell(glm::vec2(at))), plane_at(x, y), 1e-4);
    }
  }
}

TEST(Bilinear, FollowsTheCellsDiagonalProduct) {
  cv::Mat1b m = cv::Mat1b::zeros(2, 2);
  m(1, 1) = 100;
  EXPECT_EQ(bilinear<std::uint8_t>(m, BilinearCell(glm::dvec2(0.5, 0.25))), 12.5);
  EXPECT_EQ(bilinear<std::uint8_t>(m, BilinearCell(glm::vec2(0.5, 0.25))), 12.5F);
}

TEST(Bilinear, RefusesWhereACellIsCutOff) {
  const cv::Mat1b m = plane();
  EXPECT_TRUE(has_cell(m, {0, 0}));
  EXPECT_TRUE(has_cell(m, {kWidth - 1.001, kHeight - 1.001}));
  EXPECT_FALSE(has_cell(m, {kWidth - 1, 3}));
  EXPECT_FALSE(has_cell(m, {3, kHeight - 1}));
  EXPECT_FALSE(has_cell(m, {-0.001, 3}));
}

TEST(Bilinear, ClampsToTheBorder) {
  const cv::Mat1b m = plane();
  const glm::dvec2 far = clamped(m, glm::dvec2(1e6, -1e6), 1.001);
  EXPECT_TRUE(has_cell(m, far));
  EXPECT_NEAR(bilinear<std::uint8_t>(m, BilinearCell(far)), plane_at(kWidth - 1, 0), 0.01);
  const glm::dvec2 inside(3.5, 4.25);
  EXPECT_EQ(clamped(m, inside, 1.001), inside);
}

TEST(SampleWithSlope, IsExactOnAPlaneInBothPrecisions) {
  const cv::Mat1b m = plane();
  const auto check = [](const Sample& s, glm::dvec2 at) {
    EXPECT_NEAR(s.value, plane_at(at.x, at.y), 1e-4);
    EXPECT_NEAR(s.dx, 5, 1e-4);
    EXPECT_NEAR(s.dy, 3, 1e-4);
  };
  for (const glm::dvec2 at : {glm::dvec2(1, 1), {5.3, 7.9}, {kWidth - 2.1, kHeight - 2.1}}) {
    Sample s;
    ASSERT_TRUE(sample_with_slope(m, at, s));
    check(s, at);
    ASSERT_TRUE(sample_with_slope(m, glm::vec2(at), s));
    check(s, at);
  }
}

TEST(SampleWithSlope, RefusesNearTheBorder) {
  const cv::Mat1b m = plane();
  Sample s;
  for (const glm::dvec2 at : {glm::dvec2(0.9, 5), {5, 0.9}, {kWidth - 2, 5}, {5, kHeight - 2}, {-7, 5}})
    EXPECT_FALSE(sample_with_slope(m, at, s)) << at.x << ' ' << at.y;
}

}  // namespace
}  // namespace fbs
