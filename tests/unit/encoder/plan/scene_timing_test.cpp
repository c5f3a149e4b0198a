#include "encoder/plan/scene_timing.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

SceneTiming timing_at(Rational fps, int group_pictures = 0) {
  VideoFormat format;
  format.frame_rate = fps;
  EncoderSettings settings;
  settings.group_pictures = group_pictures;
  return {format, settings};
}

TEST(SceneTiming, GroupsAreASecondAndTheLookaheadTwo) {
  EXPECT_EQ(timing_at({30000, 1001}).group_pictures, 30U);
  EXPECT_EQ(timing_at({30000, 1001}).lookahead, 60U);
  EXPECT_EQ(timing_at({12, 1}).group_pictures, 12U);
  EXPECT_EQ(timing_at({12, 1}).nominal_duration, 7500U);
}

TEST(SceneTiming, GroupsStayWithinTheFormatsLimits) {
  EXPECT_EQ(timing_at({1000, 1}).group_pictures, 256U);
  EXPECT_EQ(timing_at({1, 10}).group_pictures, 1U);
  EXPECT_EQ(timing_at({1, 10}).lookahead, 1U);
}

TEST(SceneTiming, AKeyIntervalHasRoomForTheFirstGroupAndAnother) {
  VideoFormat format;
  format.frame_rate = {25, 1};
  EncoderSettings settings;
  for (const auto& [interval, pictures] : {std::pair{1.0, 24U}, {0.3, 6U}, {0.04, 1U}, {9.0, 25U}}) {
    settings.key_interval = interval;
    EXPECT_EQ(SceneTiming(format, settings).group_pictures, pictures) << interval;
  }
}

TEST(SceneTiming, FirstPictureIsAGroupOfItsOwn) {
  const SceneTiming timing = timing_at({25, 1}, 4);
  EXPECT_TRUE(timing.group_ends(1, 1));
  EXPECT_FALSE(timing.group_ends(3, 4));
  EXPECT_TRUE(timing.group_ends(4, 5));
}

}  // namespace
}  // namespace fbs
