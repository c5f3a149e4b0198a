#include "tests/talker/talker_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/talker/small_clip.h"

namespace fbs::talker {
namespace {

TEST(TalkerMotion, StartsFrontalAndNeutral) {
  for (const Motion motion :
       {Motion::kDefault, Motion::kTurns, Motion::kTalk, Motion::kBrows, Motion::kBlink, Motion::kLong}) {
    Settings settings = small();
    settings.motion = motion;
    const Moment start = Talker(settings).truth(0);
    EXPECT_EQ(start.pose.pitch_deg, 0);
    EXPECT_EQ(start.pose.yaw_deg, 0);
    EXPECT_EQ(start.pose.roll_deg, 0);
    EXPECT_NEAR(start.pose.scale_px, settings.eye_distance * 80, 1e-4);
    EXPECT_EQ(start.expression.mouth_open, 0);
    EXPECT_EQ(start.expression.brow_left, 0);
    EXPECT_NEAR(start.expression.eye_open_right, kEyeOpenNeutral, 1e-6);
    EXPECT_NEAR(start.expression.eye_open_left, kEyeOpenNeutral, 1e-6);
  }
}

TEST(TalkerMotion, PoseStaysWithinItsAmplitudes) {
  Settings settings = small();
  settings.frame_count = 3000;
  const Talker talker(settings);
  float widest = 0;
  for (int i = 0; i < settings.frame_count; ++i) {
    const Pose pose = talker.truth(i).pose;
    EXPECT_LE(std::abs(pose.yaw_deg), settings.yaw_deg);
    EXPECT_LE(std::abs(pose.pitch_deg), settings.pitch_deg);
    EXPECT_LE(std::abs(pose.roll_deg), settings.roll_deg);
    widest = std::max(widest, std::abs(pose.yaw_deg));
  }
  EXPECT_GT(widest, 0.7f * settings.yaw_deg);
}

TEST(TalkerMotion, SignsOfRotationAreThoseOfTheDocumentation) {
  const glm::vec3 nose{0, 0, -1}, left_eye{1, 0, 0};
  EXPECT_LT(project({.yaw_deg = 10}, nose).x, 0);       // turns to the left of the picture
  EXPECT_GT(project({.pitch_deg = 10}, nose).y, 0);     // looks down
  EXPECT_GT(project({.roll_deg = 10}, left_eye).y, 0);  // clockwise
}

TEST(TalkerMotion, StillHoldsThePose) {
  Settings settings = small();
  settings.still = true;
  const Talker talker(settings);
  const Pose first = talker.truth(0).pose, later = talker.truth(60).pose;
  EXPECT_EQ(later.yaw_deg, 0);
  EXPECT_EQ(later.shift_px, first.shift_px);
  EXPECT_EQ(later.scale_px, first.scale_px);
  EXPECT_GT(talker.truth(most_open(talker)).expression.mouth_open, 0);
}

}  // namespace
}  // namespace fbs::talker
