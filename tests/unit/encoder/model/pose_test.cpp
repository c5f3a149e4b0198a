#include "encoder/model/pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "decoder/head/head_projection.h"

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

TEST(Pose, NumbersAreThoseOfTheState) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const Pose pose = random_pose(random);
    const auto numbers = numbers_of(pose);
    EXPECT_NEAR(numbers[kYaw], pose.yaw / (2 * std::numbers::pi) * 65536, 1e-9);
    EXPECT_NEAR(numbers[kShiftX], pose.shift.x * 64, 1e-9);
    EXPECT_NEAR(numbers[kLogScale], pose.log2_scale * 4096, 1e-9);
    State state;
    for (std::size_t k = 0; k < kPoseCount; ++k)
      state.pose[k] = static_cast<std::int32_t>(std::lround(numbers[k]));
    const auto back = numbers_of(pose_of(state));
    for (std::size_t k = 0; k < kPoseCount; ++k) EXPECT_NEAR(back[k], state.pose[k], 1e-6) << k;
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
  for (int i = 0; i < 300; ++i) {
    State state;
    const auto numbers = numbers_of(random_pose(random));
    for (std::size_t k = 0; k < kPoseCount; ++k)
      state.pose[k] = static_cast<std::int32_t>(std::lround(numbers[k]));
    const PoseProjection continuous(pose_of(state));
    const HeadProjection integer(head_pose(state));
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
