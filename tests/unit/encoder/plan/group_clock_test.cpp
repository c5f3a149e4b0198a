#include "encoder/plan/group_clock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

namespace fbs {
namespace {

using Durations = std::vector<std::uint32_t>;

constexpr std::uint32_t kNominal = 3000;

/// A picture that begins at this time, and is expected to last for `duration`.
PictureTime at(std::uint64_t begin, std::uint32_t duration = 0) {
  return {duration, begin};
}

TEST(GroupClock, DurationsStayAsTheyAreAdded) {
  GroupClock clock({7, 100}, kNominal);
  clock.add(0);
  clock.add(kNominal + 1);
  EXPECT_EQ(clock.pictures(), 2U);
  EXPECT_EQ(clock.position(), (StreamPosition{9, 100 + 2 * kNominal + 1}));
  EXPECT_EQ(clock.end_group(), (Durations{0, kNominal + 1}));
  EXPECT_EQ(clock.pictures(), 0U);
}

TEST(GroupClock, APictureOfAGroupEndsWhereTheNextOneBegins) {
  GroupClock clock({}, kNominal);
  for (const std::uint64_t begin : {0, 5000, 5500, 100'000}) clock.add(at(begin));
  EXPECT_EQ(clock.end_group(), (Durations{5000, 500, 94'500, 0}));
}

TEST(GroupClock, AGroupLastsAsLongAsItsPictures) {
  GroupClock clock({7, 100}, kNominal);
  EXPECT_EQ(clock.lasts(), 0U);
  for (const std::uint64_t begin : {100, 5100}) clock.add(at(begin));
  EXPECT_EQ(clock.lasts(), 5000 + kNominal);
  clock.end_at(6000);
  EXPECT_EQ(clock.lasts(), 5900U);
  EXPECT_EQ(clock.last(), 900U);
  (void)clock.end_group();
  EXPECT_EQ(clock.lasts(), 0U);
  clock.go_on({20, 70'000});
  clock.add(0);
  EXPECT_EQ(clock.lasts(), kNominal);
}

TEST(GroupClock, TheNextGroupMakesUpForTheLastPictureOfTheOneBefore) {
  GroupClock clock({}, kNominal);
  clock.add(at(0));
  EXPECT_EQ(clock.end_group(), Durations{0});
  clock.add(at(12'000, 12'000));
  clock.add(at(24'000, 12'000));
  EXPECT_EQ(clock.end_group(), (Durations{21'000, 12'000})) << "shown at 3000, 24000";
  EXPECT_EQ(clock.position(), (StreamPosition{3, 36'000}));
}

TEST(GroupClock, PicturesLastATickUntilThereIsTimeAgain) {
  GroupClock clock({}, kNominal);
  clock.add(at(0, 9000));
  EXPECT_EQ(clock.end_group(), Durations{9000});
  for (const std::uint64_t begin : {3000, 6000, 9000, 12'000}) clock.add(at(begin));
  EXPECT_EQ(clock.end_group(), (Durations{1, 1, 2998, 0}));
  EXPECT_EQ(clock.position().time, 15'000U);
}

TEST(GroupClock, APictureLastsAMinuteAtMost) {
  GroupClock clock({}, kNominal);
  clock.add(at(0));
  clock.add(at(kMaxDuration + 50'000));
  EXPECT_EQ(clock.end_group(), (Durations{kMaxDuration, 53'000}));
}

// 29.97 pictures per second by a clock of microseconds, 7.5 by one of milliseconds.
TEST(GroupClock, RoundedTimesHaveOneDuration) {
  for (const auto& [period_us, clock_us, nominal] :
       {std::tuple{33'366.7, 1, 3003U}, {133'333.3, 1000, kNominal}}) {
    GroupClock clock({}, nominal);
    for (int n = 0; n < 3000; ++n) {
      const auto stamp = static_cast<std::int64_t>(n * period_us / clock_us) * clock_us;
      const auto begin = static_cast<std::uint64_t>(stamp * 9 / 100);
      clock.add(at(begin));
      EXPECT_NEAR(static_cast<double>(clock.position().time), static_cast<double>(begin + nominal), 1) << n;
    }
    const Durations durations = clock.end_group();
    if (nominal == 3003) {
      EXPECT_GT(std::ranges::count(durations, 0U), 2980) << "which costs no bits";
    }
  }
}

TEST(GroupClock, GoesOnElsewhere) {
  GroupClock clock({}, kNominal);
  clock.add(at(0));
  EXPECT_EQ(clock.end_group(), Durations{0});
  clock.go_on({10, 50'000});
  clock.add(at(50'100));
  EXPECT_EQ(clock.end_group(), Durations{kNominal + 100});
  EXPECT_EQ(clock.position(), (StreamPosition{11, 53'100}));
}

}  // namespace
}  // namespace fbs
