#include "library/picture_stamps.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

constexpr std::uint32_t kNominal = 3000;
constexpr std::int64_t kMinute = kMaxDuration;

fbs_stamp stamp(std::int64_t time, std::uint32_t duration = 0, std::uint64_t user = 0) {
  return {sizeof(fbs_stamp), time, user, duration};
}

TEST(PictureStamps, TimesBeginWithTheFirst) {
  for (const std::int64_t origin : {std::int64_t{0}, std::int64_t{-5'000'000}, std::int64_t{1} << 60}) {
    PictureStamps stamps(kNominal);
    EXPECT_EQ(stamps.add(stamp(origin)).begin, 0U);
    EXPECT_EQ(stamps.add(stamp(origin + 123)).begin, 123U);
  }
}

TEST(PictureStamps, TheShorterOfTwoDurationsIsExpected) {
  PictureStamps stamps(kNominal);
  EXPECT_EQ(stamps.add(stamp(0)).duration, 0U) << "the frame rate's";
  EXPECT_EQ(stamps.add(stamp(12'000)).duration, 12'000U);
  EXPECT_EQ(stamps.add(stamp(500'000)).duration, 12'000U) << "a gap is no rule";
  EXPECT_EQ(stamps.add(stamp(503'000)).duration, 3000U);
  EXPECT_EQ(stamps.add(stamp(506'000, 77)).duration, 77U) << "as it is told";
}

TEST(PictureStamps, AnotherPictureWithoutATimeFollowsTheOneBefore) {
  PictureStamps stamps(kNominal);
  const PictureTime first = stamps.add(stamp(FBS_NO_TIME, 5000));
  EXPECT_EQ(first.duration, 5000U);
  EXPECT_FALSE(first.begin);
  EXPECT_EQ(stamps.add(stamp(777)).begin, 5000U) << "where the picture before ends";
  EXPECT_FALSE(stamps.add(stamp(FBS_NO_TIME)).begin);
  EXPECT_EQ(stamps.add(stamp(9777)).begin, 14'000U);
}

TEST(PictureStamps, LongerThanAMinuteCountsAsAMinute) {
  PictureStamps stamps(kNominal);
  stamps.add(stamp(0));
  EXPECT_EQ(stamps.add(stamp(3 * kMinute)).begin, kMinute);
  EXPECT_EQ(stamps.add(stamp(3 * kMinute + 10)).begin, kMinute + 10);
}

TEST(PictureStamps, TimesRise) {
  PictureStamps stamps(kNominal);
  const auto fits = [&](std::int64_t time) { return stamps.fault_of(stamp(time)) == nullptr; };
  constexpr std::int64_t kMost = std::int64_t{1} << 61;
  EXPECT_TRUE(fits(-kMost));
  EXPECT_FALSE(fits(-kMost - 1));
  EXPECT_TRUE(fits(kMost));
  EXPECT_FALSE(fits(kMost + 1));
  stamps.add(stamp(-kMost));
  EXPECT_FALSE(fits(-kMost));
  EXPECT_TRUE(fits(FBS_NO_TIME));
  EXPECT_TRUE(fits(kMost)) << "a clock that was set";
  EXPECT_EQ(stamps.add(stamp(kMost)).begin, kMinute);
  EXPECT_NE(stamps.fault_of(stamp(FBS_NO_TIME, kMaxDuration + 1)), nullptr);
}

TEST(PictureStamps, AreKeptUntilTheyAreForgotten) {
  PictureStamps stamps(kNominal);
  for (std::uint64_t n = 0; n < 5; ++n) stamps.add(stamp(static_cast<std::int64_t>(100 * n), 0, 10 + n));
  stamps.forget(2);
  EXPECT_EQ(stamps.of(1), nullptr);
  ASSERT_NE(stamps.of(2), nullptr);
  EXPECT_EQ(stamps.of(2)->user, 12U);
  EXPECT_EQ(stamps.of(4)->time, 400);
  EXPECT_EQ(stamps.of(5), nullptr);
  stamps.forget(9);
  EXPECT_EQ(stamps.of(4), nullptr);
}

}  // namespace
}  // namespace fbs
