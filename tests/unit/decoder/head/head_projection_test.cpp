#include "decoder/head/head_projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "bitstream/payload/geometry_payload.h"
#include "tests/unit/decoder/head/plain_projection.h"

namespace fbs {
namespace {

HeadPose random_pose(std::mt19937& random) {
  const auto within = [&](int a, int b) { return std::uniform_int_distribution<int>(a, b)(random); };
  const int angle = kMaxRotation;
  return {within(-angle, angle), within(-angle, angle), within(-angle, angle),
          within(0, 400 * 64),   within(0, 300 * 64),   within(3 * 4096, kMaxLogScale)};
}

// The rotation is in Q14: its share of the error grows with the head and is 1/32 pixel at 80 pixels between
// the eyes.
TEST(HeadProjection, IsWithinA32thOfAPixelOfThePlainOne) {
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    const HeadPose pose = random_pose(random);
    const HeadProjection projection(pose);
    const PlainProjection plain(pose);
    const double tolerance = std::max(1.0, std::exp2(pose.log_scale / 4096.0) / 72) / 32;
    for (const HeadVertex& v : generic_head().vertices) {
      const glm::ivec3 got = projection(v.position);
      const glm::dvec2 expected = plain(glm::dvec3(v.position));
      ASSERT_NEAR(got.x / 64.0, expected.x, tolerance);
      ASSERT_NEAR(got.y / 64.0, expected.y, tolerance);
      ASSERT_NEAR(got.z, (plain.rotation * glm::dvec3(v.position)).z, 2);  // head units
    }
  }
}

TEST(HeadProjection, SignsOfRotationAreThoseOfTheDocumentation) {
  const glm::ivec3 nose(0, 0, -4096), left_eye(2048, 0, 0);
  HeadPose pose;
  pose.log_scale = 5 * 4096;
  pose.pitch = 1000;
  EXPECT_GT(HeadProjection(pose)(nose).y, 0) << "looks down";
  pose.pitch = 0;
  pose.yaw = 1000;
  EXPECT_LT(HeadProjection(pose)(nose).x, 0) << "looks to the picture's left";
  pose.yaw = 0;
  pose.roll = 1000;
  EXPECT_GT(HeadProjection(pose)(left_eye).y, 0) << "rolls clockwise";
}

TEST(HeadProjection, ScreenPositionsAreClamped) {
  HeadPose pose;
  pose.log_scale = kMaxLogScale;
  pose.shift_x = kMaxTranslation;
  pose.shift_y = -kMaxTranslation;
  const HeadProjection projection(pose);
  EXPECT_EQ(glm::ivec2(projection({kMaxCoordinate, -kMaxCoordinate, 0})),
            glm::ivec2(kMaxScreen, -kMaxScreen));
}

TEST(HeadPose, HasTheNumbersOfTheState) {
  State state;
  state.pose = {1, -2, 3, -4, 5, 6};
  EXPECT_EQ(head_pose(state), (HeadPose{1, -2, 3, -4, 5, 6}));
}

}  // namespace
}  // namespace fbs
