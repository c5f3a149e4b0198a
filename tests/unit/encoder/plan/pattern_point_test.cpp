#include "encoder/plan/pattern_point.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace fbs {
namespace {

TEST(PatternPoint, HigherQualityHasMoreAndFinerPatterns) {
  for (int quality = 1; quality <= 100; ++quality) {
    const PatternPoint below = PatternPoint::at(quality - 1), point = PatternPoint::at(quality);
    EXPECT_GT(point.per_second, below.per_second) << quality;
    EXPECT_LE(point.quantiser, below.quantiser) << quality;
    EXPECT_GE(point.motion_quality, below.motion_quality) << quality;
  }
  EXPECT_LT(PatternPoint::at(100).quantiser, PatternPoint::at(0).quantiser);
  EXPECT_GE(PatternPoint::at(100).quantiser, 0);
  EXPECT_LE(PatternPoint::at(0).quantiser, 63);
}

TEST(PatternPoint, QualityBeyondItsRangeIsTheNearest) {
  EXPECT_EQ(PatternPoint::at(-5).per_second, PatternPoint::at(0).per_second);
  EXPECT_EQ(PatternPoint::at(140).quantiser, PatternPoint::at(100).quantiser);
}

TEST(PatternPoint, BitsOfCoarserPatternsAreDearer) {
  for (int quantiser = 1; quantiser <= 63; ++quantiser)
    EXPECT_GT(pattern_lambda(quantiser), pattern_lambda(quantiser - 1));
}

TEST(PatternPoint, MotionIsFinerAtHigherRates) {
  for (const bool live : {false, true})
    for (double kbps = 1; kbps < 30; kbps *= 2)
      EXPECT_GE(motion_quality_at(2 * kbps, live), motion_quality_at(kbps, live));
}

}  // namespace
}  // namespace fbs
