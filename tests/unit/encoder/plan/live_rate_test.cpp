#include "encoder/plan/live_rate.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

constexpr double kKbps = 8, kBytesPerSecond = 1000, kBuffer = 2;

TEST(LiveRate, AnEmptyBucketHoldsWhatTheChannelTakesWithinTheBuffer) {
  EXPECT_EQ(LiveRate(kKbps, kBuffer).room(), kBytesPerSecond * kBuffer);
}

TEST(LiveRate, WhatIsSentWaitsUntilTheChannelHasTakenIt) {
  LiveRate rate(kKbps, kBuffer);
  rate.add(1500, 0);
  EXPECT_EQ(rate.room(), 500);
  rate.add(0, 1);
  EXPECT_EQ(rate.room(), 1500);
  rate.add(0, 10);
  EXPECT_EQ(rate.room(), 2000) << "an idle channel saves nothing up";
}

TEST(LiveRate, LessMayBeSentForAShorterWait) {
  LiveRate rate(kKbps, kBuffer);
  rate.add(300, 0);
  EXPECT_EQ(rate.room(0.5), 200);
  EXPECT_EQ(rate.room(0.1), -200);
}

TEST(LiveRate, TheChannelMayChange) {
  LiveRate rate(kKbps, kBuffer);
  rate.add(1500, 0);
  const double before = rate.target();
  rate.set(kKbps / 2);
  EXPECT_EQ(rate.room(), -500) << "what waits stays";
  EXPECT_LT(rate.target(), before / 2) << "and is more of what the buffer holds now";
  rate.add(0, 1);
  EXPECT_EQ(rate.room(), 0);
  rate.set(kKbps);
  rate.add(0, 10);
  EXPECT_EQ(rate.room(), kBytesPerSecond * kBuffer);
  EXPECT_GT(rate.target(), 1000 * kKbps) << "it was idle";
}

TEST(LiveRate, MoreThanTheBufferLeavesNoRoom) {
  LiveRate rate(kKbps, kBuffer);
  rate.add(3000, 0.5);
  EXPECT_EQ(rate.room(), -500);
}

TEST(LiveRate, SpendingTheTargetSettlesAtTheChannelsRate) {
  LiveRate rate(kKbps, kBuffer);
  for (int i = 0; i < 300; ++i) rate.add(rate.target() / 8 * 0.2, 0.2);
  EXPECT_NEAR(rate.target(), 1000 * kKbps, 10);
  EXPECT_GT(rate.room(), 0.5 * kBytesPerSecond * kBuffer) << "and little waits";
  EXPECT_LT(rate.room(), kBytesPerSecond * kBuffer) << "but something, so that the channel is not idle";
}

TEST(LiveRate, PlansThatTakeMoreOrLessThanTheySayAreCorrected) {
  for (const double taken : {0.7, 1.5}) {
    LiveRate rate(kKbps, kBuffer);
    double sent = 0;
    for (int i = 0; i < 300; ++i) {
      const double bytes = taken * rate.target() / 8 * 0.2;
      rate.add(bytes, 0.2);
      if (i >= 150) sent += bytes;
      EXPECT_GT(rate.room(), 0) << taken;
    }
    EXPECT_NEAR(sent / 30, kBytesPerSecond, 0.02 * kBytesPerSecond) << taken;
  }
}

TEST(LiveRate, TheTargetIsBoundedAfterALongRest) {
  LiveRate rate(kKbps, kBuffer);
  for (int i = 0; i < 1000; ++i) rate.add(0, 1);
  EXPECT_GT(rate.target(), 1000 * kKbps);
  EXPECT_LT(rate.target(), 3000 * kKbps);
}

}  // namespace
}  // namespace fbs
