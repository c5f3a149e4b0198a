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

TEST(SceneTiming, AKeyIntervalIsInPicturesAndTenSecondsOfALiveScene) {
  VideoFormat format;
  format.frame_rate = {30000, 1001};
  EncoderSettings settings;
  EXPECT_EQ(SceneTiming(format, settings).key_pictures, 0U);
  for (const auto& [interval, pictures] : {std::pair{10.0, 300U}, {0.3, 9U}, {0.01, 1U}}) {
    settings.key_interval = interval;
    const SceneTiming timing(format, settings);
    EXPECT_EQ(timing.key_pictures, pictures) << interval;
    EXPECT_TRUE(timing.group_ends(1, pictures)) << interval;
  }
  settings.key_interval = 0;
  settings.live.emplace();
  EXPECT_EQ(SceneTiming(format, settings).key_pictures, 300U);
}

TEST(SceneTiming, FirstPictureIsAGroupOfItsOwn) {
  const SceneTiming timing = timing_at({25, 1}, 4);
  EXPECT_TRUE(timing.group_ends(1, 1));
  EXPECT_FALSE(timing.group_ends(3, 4));
  EXPECT_TRUE(timing.group_ends(4, 5));
}

}  // namespace
}  // namespace fbs
