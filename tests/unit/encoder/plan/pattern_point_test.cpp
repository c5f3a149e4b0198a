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

TEST(RegularTimes, RiseFromTheFirstToTheLastPictureAtEvenDistances) {
  for (std::size_t pictures = 2; pictures < 40; ++pictures) {
    for (std::size_t count = 2; count <= pictures; ++count) {
      const auto times = regular_times(pictures, count);
      ASSERT_EQ(times.size(), count);
      EXPECT_EQ(times.front(), 0U);
      EXPECT_EQ(times.back(), pictures - 1);
      const std::size_t gap = (pictures - 1) / (count - 1);
      for (std::size_t k = 1; k < count; ++k) {
        ASSERT_GT(times[k], times[k - 1]) << pictures << ' ' << count;
        EXPECT_GE(times[k] - times[k - 1], gap);
        EXPECT_LE(times[k] - times[k - 1], gap + 1);
      }
    }
  }
}

TEST(RegularTimes, ThereAreAsManyAsPicturesAtMostAndOneAtLeast) {
  EXPECT_EQ(regular_times(3, 10), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(regular_times(1, 2), std::vector<std::size_t>{0});
  EXPECT_EQ(regular_times(9, 0), std::vector<std::size_t>{0});
}

}  // namespace
}  // namespace fbs
