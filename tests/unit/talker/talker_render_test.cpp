#include "tests/talker/talker_render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/unit/talker/small_clip.h"

namespace fbs::talker {
namespace {

double difference(const Plane& a, const Plane& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.samples.size(); ++i) sum += std::abs(a.samples[i] - b.samples[i]);
  return sum / static_cast<double>(a.samples.size());
}

TEST(TalkerRender, SameSettingsGiveTheSameBytes) {
  Settings settings = small();
  settings.noise = 2;
  EXPECT_EQ(Talker(settings).picture(7), Talker(settings).picture(7));
  settings.seed = 2;
  EXPECT_NE(Talker(settings).picture(7), Talker(small()).picture(7));
}

TEST(TalkerRender, EyeCentresOfFrameZeroAreOneEyeDistanceApart) {
  const Talker talker(small());
  const auto p = talker.points(0);
  const glm::vec2 right = 0.5f * (p[36] + p[39]), left = 0.5f * (p[42] + p[45]);
  EXPECT_NEAR(left.x - right.x, talker.truth(0).pose.scale_px, 0.01);
  EXPECT_NEAR(left.y, right.y, 0.01);
}

TEST(TalkerRender, LandmarksStayInsideThePicture) {
  const Talker talker(small());
  for (int i = 0; i < talker.settings().frame_count; ++i) {
    for (const glm::vec2 p : talker.points(i)) {
      EXPECT_TRUE(p.x >= 0 && p.x <= 95 && p.y >= 0 && p.y <= 79)
          << "frame " << i << ": " << p.x << ' ' << p.y;
    }
  }
}

TEST(TalkerRender, OpenMouthHasAWideLipGapAndADarkInside) {
  const Talker talker(small());
  const int open = most_open(talker);
  const Moment moment = talker.truth(open);
  const auto closed_points = talker.points(0), open_points = talker.points(open);
  EXPECT_LT(glm::length(closed_points[66] - closed_points[62]), 0.05f);
  EXPECT_NEAR(glm::length(open_points[66] - open_points[62]),
              moment.expression.mouth_open * moment.pose.scale_px,
              0.15f * moment.expression.mouth_open * moment.pose.scale_px);
  EXPECT_GT(moment.expression.mouth_open, 0.15f);
}

TEST(TalkerRender, LongEndsWhereItBegan) {
  Settings settings = small();
  settings.motion = Motion::kLong;
  const Talker talker(settings);
  EXPECT_EQ(talker.picture(0), talker.picture(settings.frame_count - 1));
  EXPECT_EQ(talker.points(3), talker.points(settings.frame_count - 4));
}

TEST(TalkerRender, MovesThePictureAndNotTheBackground) {
  const Talker talker(small());
  const Picture first = talker.picture(0), later = talker.picture(45);
  EXPECT_GT(difference(first.y, later.y), 0.5);
  for (int y = 0; y < 8; ++y) EXPECT_EQ(first.y.row(y)[2], later.y.row(y)[2]);
}

}  // namespace
}  // namespace fbs::talker
