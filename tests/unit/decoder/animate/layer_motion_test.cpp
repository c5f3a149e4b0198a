#include "decoder/animate/layer_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "tests/unit/decoder/head/plain_projection.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

HeadPose random_pose(std::mt19937& random) {
  State s = toy_state();
  for (const int k : {kPitch, kYaw, kRoll}) s.pose[k] = static_cast<int>(random() % 10000) - 5000;
  for (const int k : {kShiftX, kShiftY, kLogScale}) s.pose[k] += static_cast<int>(random() % 2000) - 1000;
  return head_pose(s);
}

TEST(HeadPlane, SamePoseDisplacesNothing) {
  std::mt19937 random(1);
  for (int i = 0; i < 20; ++i) {
    const HeadPose pose = random_pose(random);
    EXPECT_EQ(HeadPlane(pose, pose).displacement({12345, -678}), glm::ivec2(0));
  }
}

// A point of the plane z = 0 of the head frame, projected in both poses.
TEST(HeadPlane, CarriesThePlaneOfTheHeadFrame) {
  std::mt19937 random(2);
  for (int i = 0; i < 500; ++i) {
    const HeadPose from = random_pose(random), to = random_pose(random);
    const PlainProjection before(from), after(to);
    const auto units = [&] { return static_cast<double>(random() % 16384) - 8192; };
    const glm::dvec3 p(units(), units(), 0);
    const glm::ivec2 seen(glm::round(before(p) * 64.0));
    const glm::dvec2 expected = after(p) * 64.0 - glm::dvec2(seen),
                     got(HeadPlane(from, to).displacement(seen));
    ASSERT_NEAR(got.x, expected.x, 4) << i;
    ASSERT_NEAR(got.y, expected.y, 4) << i;
  }
}

TEST(HeadPlane, DisplacesNothingWhenSeenFromTheSide) {
  HeadPose from = head_pose(toy_state()), to = head_pose(toy_state(90, 50));
  from.yaw = 16000;
  EXPECT_EQ(HeadPlane(from, to).displacement({100, 200}), glm::ivec2(0));
  from.yaw = 14000;
  EXPECT_NE(HeadPlane(from, to).displacement({100, 200}), glm::ivec2(0));
}

// 1/256 eye distance from the head's origin.
TEST(SimilarityDisplacement, IsShiftScaleAndRotation) {
  const std::array<std::int32_t, kSimilarityCount> from = {10, 20, 30, 40};
  const auto at = [&](std::array<std::int32_t, kSimilarityCount> to, glm::ivec2 p) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += from[i];
    return similarity_displacement(from, to, p);
  };
  EXPECT_EQ(at({5, -7, 0, 0}, {900, 100}), glm::ivec2(5, -7));
  EXPECT_EQ(at({0, 0, 640, 0}, {256, 512}), glm::ivec2(640, 1280));
  EXPECT_EQ(at({0, 0, 0, 640}, {256, 0}), glm::ivec2(0, 640)) << "clockwise";
  EXPECT_EQ(at({0, 0, 0, 640}, {0, 256}), glm::ivec2(-640, 0));
  EXPECT_EQ(at({0, 0, 1, 0}, {128, 127}), glm::ivec2(1, 0)) << "halves go up";
  EXPECT_EQ(at({kMaxTranslation, 0, kMaxTranslation, 0}, {16384, 0}).x, kMaxScreen);
}

}  // namespace
}  // namespace fbs
