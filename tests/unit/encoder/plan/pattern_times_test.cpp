#include "encoder/plan/pattern_times.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace fbs {
namespace {

using Times = std::vector<std::size_t>;

Times of_one_shot(std::size_t pictures, std::size_t count) {
  return pattern_times(std::vector<Shot>{{pictures, false}}, count);
}

TEST(PatternTimes, RiseFromTheFirstToTheLastPictureAtEvenDistances) {
  for (std::size_t pictures = 2; pictures < 40; ++pictures) {
    for (std::size_t count = 2; count <= pictures; ++count) {
      const auto times = of_one_shot(pictures, count);
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

TEST(PatternTimes, ThereAreAsManyAsPicturesAtMost) {
  EXPECT_EQ(of_one_shot(3, 10), (Times{0, 1, 2}));
  EXPECT_EQ(of_one_shot(1, 2), Times{0});
}

TEST(PatternTimes, EachShotHasItsOwn) {
  const std::vector<Shot> shots = {{40, false}, {20, true}, {30, false}};
  EXPECT_EQ(pattern_times(shots, 3), (Times{0, 49, 74}));
  const Times times = pattern_times(shots, 9);
  ASSERT_EQ(times.size(), 9U);
  EXPECT_TRUE(std::ranges::is_sorted(times));
  const auto within = [&](std::size_t first, std::size_t end) {
    return std::ranges::count_if(times, [&](std::size_t t) { return t >= first && t < end; });
  };
  EXPECT_EQ(within(0, 40), 4);
  EXPECT_EQ(within(40, 60), 2);
  EXPECT_EQ(within(60, 90), 3);
}

TEST(PatternTimes, StillShotsNeedFew) {
  const std::vector<Shot> shots = {{40, false}, {400, true}};
  const Times times = pattern_times(shots, 20);
  EXPECT_EQ(std::ranges::count_if(times, [](std::size_t t) { return t >= 40; }), 3);
  EXPECT_EQ(times.size(), 20U);
}

TEST(PatternTimes, LongShotsComeFirstWherePatternsAreFew) {
  const std::vector<Shot> shots = {{5, false}, {10, false}, {80, false}};
  EXPECT_EQ(pattern_times(shots, 1), Times{0});
  EXPECT_EQ(pattern_times(shots, 2), (Times{0, 15 + 39}));
}

TEST(PatternCount, IsThatOfASingleShotPlusWhatCutsTake) {
  EXPECT_EQ(pattern_count(std::vector<Shot>{{100, false}}, 8), 8U);
  EXPECT_EQ(pattern_count(std::vector<Shot>{{100, true}}, 8), 3U);
  EXPECT_EQ(pattern_count(std::vector<Shot>{{100, true}}, 2), 2U);
  EXPECT_EQ(pattern_count(std::vector<Shot>{{50, false}, {50, false}, {50, false}}, 8), 9U);
  EXPECT_EQ(pattern_count(std::vector<Shot>{{50, false}, {50, true}}, 8), 4U + 3U);
  EXPECT_EQ(pattern_count(std::vector<Shot>(9, Shot{10, false}), 1), 9U);
}

}  // namespace
}  // namespace fbs
