#include "encoder/find/face_yaw.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

FaceFrame frame_of(TalkerClip& clip, int picture) {
  const auto eyes = *clip.marks(picture).eyes();
  return {clip[picture], eyes[0], eyes[1]};
}

// The clip turns to and fro: where the truth is far to one side, so is what is found.
TEST(EstimateYaw, FindsTheSideAndSomeOfTheAngle) {
  auto settings = talker_settings(352, 288, 120);
  settings.yaw_deg = 22;
  TalkerClip clip(settings);
  int leftmost = 0, rightmost = 0;
  for (int i = 0; i < clip.count(); ++i) {
    if (clip.pose(i).yaw > clip.pose(leftmost).yaw) leftmost = i;
    if (clip.pose(i).yaw < clip.pose(rightmost).yaw) rightmost = i;
  }
  const double left = std::atan(estimate_yaw(frame_of(clip, leftmost)).tangent);
  const double right = std::atan(estimate_yaw(frame_of(clip, rightmost)).tangent);
  ASSERT_GT(clip.pose(leftmost).yaw - clip.pose(rightmost).yaw, 0.4);
  EXPECT_GT(left, 0.5 * clip.pose(leftmost).yaw);
  EXPECT_LT(right, 0.5 * clip.pose(rightmost).yaw);
}

TEST(EstimateYaw, FrontalFaceIsNearlyFrontal) {
  TalkerClip clip(talker_settings(352, 288, 1));
  const FaceYaw yaw = estimate_yaw(frame_of(clip, 0));
  EXPECT_NEAR(yaw.tangent, 0, 0.08);
  EXPECT_NEAR(yaw.shift, 0, 0.05);
}

TEST(EstimateYaw, FlatPictureSaysNothing) {
  Picture grey(200, 200);
  for (Plane* plane : {&grey.y, &grey.u, &grey.v})
    std::fill(plane->samples.begin(), plane->samples.end(), std::uint8_t{128});
  EXPECT_EQ(estimate_yaw(FaceFrame(grey, {80, 90}, {120, 90})).tangent, 0);
}

TEST(FaceYaw, MovesADeepPointAsideAndTheEyesNot) {
  const FaceYaw yaw = {0.2, 0.05};
  EXPECT_NEAR(yaw.midline(0), 0.05, 1e-12);
  EXPECT_NEAR(yaw.midline(-0.5), -0.05, 1e-12);
  EXPECT_NEAR(yaw.seen({0.4, 1, -0.5}).x, 0.35, 1e-12);
  EXPECT_EQ(yaw.seen({0.4, 1, -0.5}).y, 1);
}

}  // namespace
}  // namespace fbs
