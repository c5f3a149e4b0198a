#include "decoder/stream/stream_clock.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <vector>

namespace fbs {
namespace {

constexpr std::uint32_t kNominal = 3000;

/// Has shown pictures of the nominal duration.
StreamClock clock_after(std::uint64_t pictures) {
  StreamClock clock;
  EXPECT_EQ(*clock.go_to({}), 0U);
  for (std::uint64_t i = 0; i < pictures; ++i) clock.show(kNominal);
  return clock;
}

std::vector<std::uint32_t> held_by(StreamClock& clock) {
  std::vector<std::uint32_t> out;
  while (clock.is_behind()) out.push_back(clock.hold(kNominal));
  return out;
}

TEST(StreamClock, BeginsWhereTheFirstSetupSays) {
  StreamClock clock;
  EXPECT_EQ(*clock.go_to({50, 7000}), 0U);
  EXPECT_FALSE(clock.is_behind());
  EXPECT_EQ(clock.start(), (StreamPosition{50, 7000}));
  clock.show(20);
  EXPECT_EQ(clock.now(), (StreamPosition{51, 7020}));
  EXPECT_EQ(clock.missing(), 0U);
}

TEST(StreamClock, BeginsAtZeroAfterALoss) {
  StreamClock clock;
  clock.lose();
  EXPECT_EQ(*clock.go_to({50, 7000}), 50U);
  EXPECT_FALSE(clock.is_behind()) << "there is no picture to be held";
  EXPECT_EQ(clock.start(), StreamPosition{});
  EXPECT_EQ(clock.now(), (StreamPosition{50, 7000}));
  EXPECT_EQ(clock.missing(), 50U);
}

TEST(StreamClock, HoldsForTheNominalDurationAndTheLastForTheRest) {
  StreamClock clock = clock_after(2);
  EXPECT_EQ(*clock.go_to({6, 6000 + 9000 + 100}), 4U);
  EXPECT_EQ(held_by(clock), (std::vector<std::uint32_t>{3000, 3000, 3000, 100}));
  EXPECT_EQ(*clock.go_to({8, 15100 + 50000}), 2U);
  EXPECT_EQ(held_by(clock), (std::vector<std::uint32_t>{3000, 47000}));
  EXPECT_EQ(clock.now(), (StreamPosition{8, 65100}));
  EXPECT_EQ(clock.held(), 6U);
}

// SPEC 6.2: as far as each can still have 1..kMaxDuration.
TEST(StreamClock, EveryHeldPictureHasADurationInRange) {
  StreamClock clock = clock_after(1);
  ASSERT_TRUE(clock.go_to({5, 3000 + 3002}));
  EXPECT_EQ(held_by(clock), (std::vector<std::uint32_t>{2999, 1, 1, 1}));
  ASSERT_TRUE(clock.go_to({8, 6002 + 2 * std::uint64_t{kMaxDuration} + 5000}));
  EXPECT_EQ(held_by(clock), (std::vector<std::uint32_t>{5000, kMaxDuration, kMaxDuration}));
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    const StreamPosition from = clock.now();
    const std::uint64_t missing = 1 + random() % 20;
    const std::uint64_t time =
        missing + random() % (missing * (random() % 2 == 0 ? 5000 : kMaxDuration - 1) + 1);
    clock.show(1);
    ASSERT_TRUE(clock.go_to({from.pictures + 1 + missing, from.time + 1 + time}));
    const auto durations = held_by(clock);
    ASSERT_EQ(durations.size(), missing);
    for (const std::uint32_t d : durations) {
      ASSERT_GE(d, 1U);
      ASSERT_LE(d, kMaxDuration);
    }
    ASSERT_EQ(std::accumulate(durations.begin(), durations.end(), std::uint64_t{0}), time);
  }
}

TEST(StreamClock, RefusesPositionsThatContradictWhatWasShown) {
  StreamClock clock = clock_after(5);
  for (const StreamPosition& wrong :
       {StreamPosition{4, 12000}, StreamPosition{5, 15001}, StreamPosition{6, 15000},
        StreamPosition{6, 14999}, StreamPosition{6, 15001 + kMaxDuration}}) {
    EXPECT_EQ(clock.go_to(wrong).error().code, ErrorCode::kInvalidStream)
        << wrong.pictures << ' ' << wrong.time;
    EXPECT_EQ(clock.now(), (StreamPosition{5, 15000}));
    EXPECT_FALSE(clock.is_behind());
  }
  EXPECT_EQ(*clock.go_to({5, 15000}), 0U);
  EXPECT_EQ(clock.go_to_end(4, kNominal).error().code, ErrorCode::kInvalidStream);
  EXPECT_EQ(*clock.go_to_end(5, kNominal), 0U);
}

TEST(StreamClock, EndIsReachedAtTheNominalRate) {
  StreamClock clock = clock_after(1);
  EXPECT_EQ(*clock.go_to_end(4, kNominal), 3U);
  EXPECT_EQ(held_by(clock), (std::vector<std::uint32_t>(3, kNominal)));
  EXPECT_EQ(*StreamClock().go_to_end(9, kNominal), 0U) << "a stream without a scene";
}

TEST(StreamClock, HoldsABoundedNumberInARow) {
  StreamClock clock = clock_after(1);
  constexpr std::uint64_t kMost = 1 + kMaxHeldPictures;
  EXPECT_EQ(*clock.go_to_end(kMost, kNominal), kMaxHeldPictures);
  EXPECT_EQ(held_by(clock).size(), kMaxHeldPictures);
  EXPECT_EQ(*clock.go_to_end(kMost + 1, kNominal), 1U);
  EXPECT_FALSE(clock.is_behind()) << "one more, without a picture between";
  clock.show(kNominal);
  EXPECT_EQ(*clock.go_to_end(kMost + 3, kNominal), 1U);
  EXPECT_EQ(held_by(clock).size(), 1U);
  const StreamPosition far{kMaxStreamPictures, kMaxStreamTime};
  EXPECT_EQ(*clock.go_to(far), kMaxStreamPictures - kMost - 3);
  EXPECT_FALSE(clock.is_behind());
  EXPECT_EQ(clock.now(), far);
  EXPECT_EQ(clock.missing(), kMaxStreamPictures - 2);
  EXPECT_EQ(clock.held(), kMaxHeldPictures + 1);
}

}  // namespace
}  // namespace fbs
