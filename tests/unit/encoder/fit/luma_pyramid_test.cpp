#include "encoder/fit/luma_pyramid.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

/// Rises by two levels per pixel of the picture across, by one down; cut at half the size.
WorkFrame ramp() {
  WorkFrame frame;
  frame.scale = 0.5;
  frame.origin = {10, 20};
  frame.luma.create(40, 40, CV_8UC1);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      const glm::dvec2 at = frame.to_picture({x, y});
      frame.luma.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(2 * (at.x - 10) + (at.y - 20));
    }
  return frame;
}

TEST(LumaPyramid, LooksUpPlacesOfThePictureOnEachLevel) {
  const LumaPyramid pyramid(ramp());
  for (int level = 0; level < kFitLevels; ++level) {
    Sample s;
    ASSERT_TRUE(pyramid.sample(level, {50, 60}, s));
    EXPECT_NEAR(s.value, 2 * 40 + 40, 1) << level;
    EXPECT_NEAR(s.dx * pyramid.scale(level), 2, 0.1) << level;
    EXPECT_NEAR(s.dy * pyramid.scale(level), 1, 0.1) << level;
  }
  EXPECT_EQ(pyramid.scale(0), 0.5);
  EXPECT_EQ(pyramid.scale(1), 0.25);
}

TEST(LumaPyramid, HasNothingOutsideAndBeforeThereIsAPicture) {
  Sample s;
  EXPECT_FALSE(LumaPyramid(ramp()).sample(0, {9, 40}, s));
  EXPECT_FALSE(LumaPyramid(ramp()).sample(1, {500, 40}, s));
  EXPECT_FALSE(LumaPyramid().sample(0, {0, 0}, s));
}

}  // namespace
}  // namespace fbs
