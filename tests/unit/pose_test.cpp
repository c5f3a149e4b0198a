#include "encoder/pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace fbs {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Pose random_pose(std::mt19937& random) {
  const auto within = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  return {within(-80, 80) * kDegree,
          within(-80, 80) * kDegree,
          within(-80, 80) * kDegree,
          {within(0, 352), within(0, 288)},
          within(4, 6.3)};  // 16..79 pixels
}

TEST(Pose, SurvivesQuantisingWithinHalfAStep) {
  std::mt19937 random(1);
  for (const QuantiserSteps steps :
       {QuantiserSteps{1, 1, 1, 1}, QuantiserSteps{}, QuantiserSteps{700, 55, 90, 300}}) {
    for (int i = 0; i < 200; ++i) {
      const Pose pose = random_pose(random);
      State state;
      state.pose = quantise(pose, steps);
      const Pose back = dequantise(state, steps);
      const double turn = 0.5001 * steps.rotation * 2 * std::numbers::pi / 65536;
      EXPECT_NEAR(back.pitch, pose.pitch, turn);
      EXPECT_NEAR(back.yaw, pose.yaw, turn);
      EXPECT_NEAR(back.roll, pose.roll, turn);
      EXPECT_NEAR(back.shift.x, pose.shift.x, 0.5001 * steps.translation / 64);
      EXPECT_NEAR(back.shift.y, pose.shift.y, 0.5001 * steps.translation / 64);
      EXPECT_NEAR(back.log2_scale, pose.log2_scale, 0.5001 * steps.log_scale / 4096);
      EXPECT_EQ(quantise(back, steps), state.pose) << "what was quantised stays";
    }
  }
}

TEST(Pose, EyeDistanceIsTheDistanceBetweenTheProjectedEyes) {
  Pose pose;
  pose.roll = 0.3;
  pose.log2_scale = std::log2(48.0);
  const PoseProjection projection(pose);
  const glm::dvec2 d = projection(glm::dvec3(kUnitsPerEyeDistance / 2.0, 0, 0)) -
                       projection(glm::dvec3(-kUnitsPerEyeDistance / 2.0, 0, 0));
  EXPECT_NEAR(pose.eye_distance_px(), 48, 1e-9);
  EXPECT_NEAR(std::hypot(d.x, d.y), 48, 1e-9);
}

// One frame, one order of rotation: the encoder's continuous projection is the decoder's.
TEST(PoseProjection, AgreesWithTheDecodersWithinA32thOfAPixel) {
  std::mt19937 random(2);
  const QuantiserSteps finest{1, 1, 1, 1};
  for (int i = 0; i < 300; ++i) {
    State state;
    state.pose = quantise(random_pose(random), finest);
    const PoseProjection continuous(dequantise(state, finest));
    const HeadProjection integer(dequantise_pose(state, finest));
    for (const HeadVertex& v : generic_head().vertices) {
      const glm::dvec2 expected = continuous(glm::dvec3(v.position));
      const glm::ivec3 got = integer(v.position);
      ASSERT_NEAR(got.x / 64.0, expected.x, 1.0 / 32);
      ASSERT_NEAR(got.y / 64.0, expected.y, 1.0 / 32);
    }
  }
}

TEST(PoseProjection, DepthGrowsAwayFromTheViewer) {
  Pose pose;
  pose.yaw = 0.5;
  const PoseProjection projection(pose);
  EXPECT_LT((projection.matrix * glm::dvec3(0, 0, -1)).z, (projection.matrix * glm::dvec3(0, 0, 1)).z);
}

}  // namespace
}  // namespace fbs
