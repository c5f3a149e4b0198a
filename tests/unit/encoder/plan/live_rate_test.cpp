#include "encoder/plan/live_rate.h"

#include <gtest/gtest.h>

#include <cmath>

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
  const double before = rate.price();
  rate.add(1500, 0);
  const double busy = rate.price();
  rate.set(kKbps / 2);
  EXPECT_EQ(rate.room(), -500) << "what waits stays";
  EXPECT_GT(rate.price(), busy) << "bits are dearer at once";
  rate.add(0, 1);
  EXPECT_EQ(rate.room(), 0);
  rate.set(kKbps);
  rate.add(0, 10);
  EXPECT_EQ(rate.room(), kBytesPerSecond * kBuffer);
  EXPECT_LT(rate.price(), before) << "it was idle";
}

TEST(LiveRate, MoreThanTheBufferLeavesNoRoom) {
  LiveRate rate(kKbps, kBuffer);
  rate.add(3000, 0.5);
  EXPECT_EQ(rate.room(), -500);
}

TEST(LiveRate, TheChannelsOwnRateKeepsThePrice) {
  LiveRate rate(kKbps, kBuffer);
  const double before = rate.price();
  for (int i = 0; i < 100; ++i) rate.add(kBytesPerSecond / 5, 0.2);
  EXPECT_NEAR(rate.price(), before, 1e-9);
}

TEST(LiveRate, ABitIsWorthMoreWhileTooMuchIsSentAndLessWhileTheChannelIsIdle) {
  LiveRate busy(kKbps, kBuffer), idle(kKbps, kBuffer);
  const double before = busy.price();
  for (int i = 0; i < 8; ++i) {
    const double busy_before = busy.price(), idle_before = idle.price();
    busy.add(2 * kBytesPerSecond, 1);
    idle.add(0, 1);
    EXPECT_GT(busy.price(), busy_before);
    EXPECT_LT(idle.price(), idle_before);
  }
  EXPECT_GT(busy.price(), std::exp(1) * before) << "twice the rate for eight seconds, and a full bucket";
  EXPECT_NEAR(idle.price(), before / std::exp(1), 1e-9);
}

TEST(LiveRate, ThePriceIsBounded) {
  LiveRate busy(kKbps, kBuffer), idle(kKbps, kBuffer);
  for (int i = 0; i < 1000; ++i) {
    busy.add(10 * kBytesPerSecond, 1);
    idle.add(0, 1);
  }
  EXPECT_EQ(busy.price(), LiveRate::kMaxFactor);
  EXPECT_EQ(idle.price(), 1 / LiveRate::kMaxFactor);
}

}  // namespace
}  // namespace fbs
