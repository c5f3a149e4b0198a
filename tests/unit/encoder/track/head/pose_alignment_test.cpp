#include "encoder/track/head/pose_alignment.h"

#include <gtest/gtest.h>

#include "tests/unit/encoder/track/head/head_case.h"

namespace fbs {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

TEST(PoseAlignment, RefinesAPoseThatIsNearlyRight) {
  HeadCase c;
  const LevelledFrame first(c.frame(0));
  Pose start = c.head.pose;
  start.shift += glm::dvec2(0.08, -0.05) * start.eye_distance_px();
  start.yaw += 5 * kDegree;
  start.log2_scale += 0.05;
  const TrackedPose found = refine(c.appearance, first, start, c.points);
  EXPECT_LT(shift_between(found.pose, c.head.pose), 0.01);
  EXPECT_NEAR(found.pose.yaw, c.head.pose.yaw, 1 * kDegree);
  EXPECT_NEAR(found.pose.log2_scale, c.head.pose.log2_scale, 0.01);
  EXPECT_GT(found.confidence, 0.98);
}

TEST(PoseAlignment, FindsALaterPose) {
  HeadCase c;
  const int later = 12;
  const TrackedPose found = refine(c.appearance, LevelledFrame(c.frame(later)), c.head.pose, c.points);
  EXPECT_NEAR(found.pose.yaw, c.true_pose(later).yaw, 4 * kDegree);
  EXPECT_LT(shift_between(found.pose, c.true_pose(later)), 0.05);
}

TEST(PoseAlignment, NeverLosesMuchOfWhatItBeganWith) {
  HeadCase c;
  const LevelledFrame now(c.frame(20));
  for (const double aside : {-0.5, 0.0, 0.3}) {
    Pose start = c.head.pose;
    start.shift.x += aside * start.eye_distance_px();
    const double before = c.appearance.correlation(now, start, c.points);
    EXPECT_GE(refine(c.appearance, now, start, c.points).confidence, before - 0.01);
  }
}

TEST(PoseAlignment, StaysWhereNothingIsSeen) {
  HeadCase c;
  Pose away = c.head.pose;
  away.shift.x += 5000;
  const Pose found = align(c.appearance, LevelledFrame(c.frame(0)), 0, away, c.points);
  EXPECT_EQ(found.shift, away.shift);
  EXPECT_EQ(found.yaw, away.yaw);
}

TEST(Frontal, TurnsAboutTheMiddleOfTheFace) {
  HeadCase c;
  Pose turned = c.head.pose;
  turned.yaw = 0.4;
  turned.pitch = -0.2;
  const Pose front = frontal(turned, c.neutral);
  EXPECT_EQ(front.yaw, 0);
  EXPECT_EQ(front.pitch, 0);
  EXPECT_EQ(front.roll, turned.roll);
  const glm::dvec3 nose = c.neutral[vertex_of_landmark(30)];
  const glm::dvec2 was = PoseProjection(turned)(nose), is = PoseProjection(front)(nose);
  EXPECT_LT(std::hypot(is.x - was.x, is.y - was.y), 0.35 * turned.eye_distance_px());
}

}  // namespace
}  // namespace fbs
