#include "encoder/plan/scene_timing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

TEST(SceneTiming, AKeyIntervalIsWholePicturesAndTenSecondsOfALiveScene) {
  VideoFormat format;
  format.frame_rate = {30000, 1001};
  EncoderSettings settings;
  EXPECT_EQ(SceneTiming(format, settings).key_pictures, 0U);
  for (const auto& [interval, pictures] : {std::pair{10.0, 300U}, {0.3, 9U}, {0.01, 1U}}) {
    settings.key_interval = interval;
    const SceneTiming timing(format, settings);
    EXPECT_EQ(timing.key_pictures, pictures) << interval;
    EXPECT_TRUE(timing.scene_is_full(pictures * 3003, 3003)) << interval;
    EXPECT_TRUE(pictures == 1 || !timing.scene_is_full((pictures - 1) * 3003, 3003)) << interval;
  }
  settings.key_interval = 0;
  settings.live.emplace();
  EXPECT_EQ(SceneTiming(format, settings).key_pictures, 300U);
}

TEST(SceneTiming, FirstPictureIsAGroupOfItsOwn) {
  const SceneTiming timing = timing_at({25, 1}, 4);
  EXPECT_TRUE(timing.group_ends(1, 3600, 3600, 1));
  EXPECT_FALSE(timing.group_ends(3, 10'800, 3600, 4));
  EXPECT_TRUE(timing.group_ends(4, 14'400, 3600, 5));
}

TEST(SceneTiming, AGroupOfAFileEndsByNumber) {
  const SceneTiming timing = timing_at({25, 1}, 4);
  EXPECT_FALSE(timing.group_ends(3, 900'000, 300'000, 4));
  EXPECT_TRUE(timing.group_ends(4, 4, 1, 5));
}

SceneTiming live_timing(Rational fps, double delay) {
  VideoFormat format;
  format.frame_rate = fps;
  EncoderSettings settings;
  settings.live.emplace().delay = delay;
  return {format, settings};
}

/// Pictures of the second group, all of which last this long.
std::size_t live_group(const SceneTiming& timing, std::uint32_t duration) {
  std::size_t out = 1;
  while (!timing.group_ends(out, out * duration, duration, 1 + out)) ++out;
  return out;
}

TEST(SceneTiming, ALiveGroupOfAConstantRateIsAsLongAsTheDelayToThePicture) {
  for (const Rational fps :
       {Rational{1, 1}, {5, 1}, {15, 2}, {24000, 1001}, {25, 1}, {30000, 1001}, {60000, 1001}, {1000, 1}})
    for (const double delay : {0.001, 0.04, 0.1, 0.2, 0.5, 0.7, 1.0, 2.0, 3.3}) {
      const SceneTiming timing = live_timing(fps, delay);
      const double pictures = fps.num * delay / std::ceil(delay) / fps.den;
      EXPECT_EQ(timing.group_pictures, std::clamp(std::lround(pictures), 1L, 256L));
      EXPECT_EQ(live_group(timing, timing.nominal_duration), timing.group_pictures)
          << fps.num << ' ' << delay;
    }
}

TEST(SceneTiming, ALiveGroupOfAnotherRateThanTheNominalOneEndsByTime) {
  constexpr std::uint32_t kDuration = 12'000;  // 7.5 pictures a second
  for (const double delay : {0.05, 0.2, 0.4, 0.7, 1.0, 2.5})
    for (const std::uint32_t fps : {1U, 10U, 30U, 240U})
      EXPECT_EQ(live_group(live_timing({fps, 1}, delay), kDuration),
                live_timing({15, 2}, delay).group_pictures)
          << fps << ' ' << delay;
  EXPECT_EQ(live_group(live_timing({30, 1}, 1), 1), 256U) << "the format's limit";
}

}  // namespace
}  // namespace fbs
