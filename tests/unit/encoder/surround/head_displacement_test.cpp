#include "encoder/surround/head_displacement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fbs {
namespace {

Pose seen() {
  Pose pose;
  pose.shift = {160, 100};
  pose.log2_scale = 5;
  pose.roll = 0.1;
  return pose;
}

TEST(HeadDisplacement, IsThatOfTheHeadsPlane) {
  Pose now = seen();
  now.yaw = 0.2;
  now.roll = -0.3;
  now.log2_scale += 0.1;
  now.shift += glm::dvec2(4, -7);
  const auto moved = HeadDisplacement::between(seen(), now);
  ASSERT_TRUE(moved);
  for (const glm::dvec3 p : {glm::dvec3(0), {4096, 0, 0}, {-2000, 5000, 0}}) {
    const glm::dvec2 was = PoseProjection(seen())(p), is = PoseProjection(now)(p), by = (*moved)(was);
    EXPECT_NEAR(by.x, is.x - was.x, 1e-9);
    EXPECT_NEAR(by.y, is.y - was.y, 1e-9);
  }
}

TEST(HeadDisplacement, NothingMovesByDefault) {
  EXPECT_EQ(HeadDisplacement()({12, 34}), glm::dvec2(0));
}

TEST(HeadDisplacement, IsUnknownWhenTheFirstPoseIsSeenEdgeOn) {
  Pose edge = seen();
  edge.yaw = std::numbers::pi / 2;
  EXPECT_FALSE(HeadDisplacement::between(edge, seen()));
}

}  // namespace
}  // namespace fbs
