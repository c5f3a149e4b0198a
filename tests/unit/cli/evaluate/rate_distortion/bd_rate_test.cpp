#include "cli/evaluate/rate_distortion/bd_rate.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fbs::cli {
namespace {

// Two pairs of curves and their BD-rates as published: JCTVC-E137 (5th meeting, Geneva, 2011), as used in
// Netflix's VMAF tests (python/test/bd_rate_calculator_test.py, BDrateCalculatorJCTVCTest).
const Curve kFirstAnchor{
    {18883.6928, 34.2911}, {33905.6656, 37.247}, {61279.976, 40.3953}, {108048.8736, 43.6471}};
const Curve kFirstTest{
    {18910.912, 34.3147}, {33928.7472, 37.2761}, {61299.9936, 40.4232}, {108061.2784, 43.6768}};
const Curve kSecondAnchor{
    {1017.6184, 32.0603}, {2394.488, 33.8977}, {7622.7456, 35.3756}, {40433.8848, 37.5761}};
const Curve kSecondTest{
    {1017.0984, 32.0822}, {2390.0944, 33.9194}, {7587.0024, 35.4025}, {40370.12, 37.5982}};

Curve scaled(Curve curve, double factor) {
  for (CurvePoint& p : curve) p.kbps *= factor;
  return curve;
}

TEST(BdRate, IsThePublishedOneToATenthOfAPercent) {
  EXPECT_NEAR(bd_rate(kFirstAnchor, kFirstTest)->percent, -0.4652, 0.001 * 0.4652);
  EXPECT_NEAR(bd_rate(kSecondAnchor, kSecondTest)->percent, -1.8780, 0.001 * 1.8780);
}

TEST(BdRate, OfHalfTheRateIsMinusHalf) {
  const auto d = bd_rate(kSecondAnchor, scaled(kSecondAnchor, 0.5));
  EXPECT_NEAR(d->percent, -50, 1e-9);
  EXPECT_EQ(d->low, 32.0603);
  EXPECT_EQ(d->high, 37.5761);
}

TEST(BdRate, TakesTheCommonRangeAlone) {
  // Straight lines in log rate, half as much rate in the range that both share.
  Curve anchor, test;
  for (int i = 0; i < 6; ++i) {
    anchor.push_back({std::pow(2, i), 30.0 + i});
    test.push_back({std::pow(2, i + 1), 32.0 + i});
  }
  const auto d = bd_rate(anchor, test);
  EXPECT_NEAR(d->percent, -50, 1e-9);
  EXPECT_EQ(d->low, 32);
  EXPECT_EQ(d->high, 35);
}

TEST(BdRate, NeedsFourPointsAndACommonRange) {
  const Curve three(kFirstAnchor.begin(), kFirstAnchor.begin() + 3);
  EXPECT_FALSE(bd_rate(kFirstAnchor, three));
  EXPECT_FALSE(bd_rate(three, kFirstAnchor));
  Curve above = kFirstAnchor;
  for (CurvePoint& p : above) p.quality += 10;
  EXPECT_FALSE(bd_rate(kFirstAnchor, above));
}

TEST(Envelope, KeepsWhatNothingCheaperBeats) {
  const Curve points{{5, 30}, {1, 20}, {4, 31}, {2, 25}, {2, 24}, {8, 31}, {9, 33}};
  const Curve expected{{1, 20}, {2, 25}, {4, 31}, {9, 33}};
  EXPECT_EQ(envelope(points), expected);
  EXPECT_TRUE(envelope({}).empty());
}

TEST(QualityAt, IsLinearOverLogRateWithinTheCurve) {
  const Curve curve{{1, 20}, {4, 30}, {16, 34}};
  EXPECT_NEAR(*quality_at(curve, 2), 25, 1e-12);
  EXPECT_NEAR(*quality_at(curve, 8), 32, 1e-12);
  EXPECT_EQ(*quality_at(curve, 1), 20);
  EXPECT_EQ(*quality_at(curve, 16), 34);
  EXPECT_FALSE(quality_at(curve, 0.99));
  EXPECT_FALSE(quality_at(curve, 16.01));
  EXPECT_FALSE(quality_at({}, 1));
}

}  // namespace
}  // namespace fbs::cli
