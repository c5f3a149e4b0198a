#include "bitstream/scene/timeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace fbs {
namespace {

/// Pictures that can be told apart: yaw and duration are their number.
Result<void> add(Timeline& timeline, int first, int count, int missing = 0) {
  std::vector<State> states(static_cast<std::size_t>(count));
  std::vector<std::uint32_t> durations;
  for (int i = 0; i < count; ++i) {
    states[i].pose[kYaw] = first + i;
    durations.push_back(static_cast<std::uint32_t>(first + i));
  }
  return timeline.add(states, durations, missing);
}

std::vector<RegionModes> modes(std::size_t count, BlendMode mode = BlendMode::kByTime) {
  RegionModes all;
  all.fill(mode);
  return std::vector<RegionModes>(count, all);
}

TEST(Timeline, EndCountsPicturesThatAreShownAndForgottenToo) {
  Timeline t;
  for (int first = 0; first < 1000; first += 100) {
    EXPECT_EQ(t.end(), first);
    ASSERT_TRUE(add(t, first, 100));
    ASSERT_TRUE(t.release(first, modes(100)));
    while (t.has_next()) t.next();
  }
  EXPECT_EQ(t.find(0), nullptr);
}

TEST(Timeline, PicturesWaitUntilTheyAreReleased) {
  Timeline t;
  ASSERT_TRUE(add(t, 0, 5));
  EXPECT_FALSE(t.has_next());
  ASSERT_TRUE(t.release(0, modes(2)));
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(t.has_next());
    const Timeline::Entry picture = t.next();
    EXPECT_EQ(picture.state.picture, i);
    EXPECT_EQ(picture.state.pose[kYaw], i);
    EXPECT_EQ(picture.duration, static_cast<std::uint32_t>(i));
  }
  EXPECT_FALSE(t.has_next());
}

TEST(Timeline, NumbersGoOnFromGroupToGroup) {
  Timeline t;
  for (int group = 0; group < 4; ++group) ASSERT_TRUE(add(t, 10 * group, 10));
  t.release_all();
  for (int i = 0; i < 40; ++i) EXPECT_EQ(t.next().state.picture, i);
}

TEST(Timeline, ReleaseGivesEachPictureItsModes) {
  Timeline t;
  ASSERT_TRUE(add(t, 0, 3));
  auto some = modes(3);
  some[1][2] = BlendMode::kStillAfter;
  ASSERT_TRUE(t.release(0, some));
  for (const RegionModes& expected : some) EXPECT_EQ(t.next().state.blend, expected);
}

/// Modes of the pictures that may be displayed.
std::vector<BlendMode> shown(Timeline& t) {
  std::vector<BlendMode> out;
  while (t.has_next()) out.push_back(t.next().state.blend[0]);
  return out;
}

constexpr auto kFirst = BlendMode{}, kBefore = BlendMode::kStillBefore, kAfter = BlendMode::kStillAfter;

TEST(Timeline, ModesMayComeAheadOfTheStates) {
  Timeline t;
  ASSERT_TRUE(t.release(0, modes(4, kAfter)));
  EXPECT_FALSE(t.has_next());
  ASSERT_TRUE(add(t, 0, 3));
  EXPECT_EQ(shown(t), std::vector(3, kAfter));
  ASSERT_TRUE(add(t, 3, 3));
  EXPECT_EQ(shown(t), std::vector{kAfter}) << "two have no modes yet";
  ASSERT_TRUE(t.release(4, modes(4, kBefore)));
  EXPECT_EQ(shown(t), std::vector(2, kBefore));
  ASSERT_TRUE(add(t, 6, 3));
  EXPECT_EQ(shown(t), std::vector(2, kBefore));
}

// SPEC 6.2
TEST(Timeline, PicturesWhoseModesAreMissingHaveTheLastOnes) {
  for (const bool ahead : {false, true}) {
    Timeline t;
    if (!ahead) {
      ASSERT_TRUE(add(t, 0, 8));
    }
    ASSERT_TRUE(t.release(1, modes(2, kBefore)));
    ASSERT_TRUE(t.release(5, modes(1, kAfter)));
    if (ahead) {
      ASSERT_TRUE(add(t, 0, 8));
    }
    EXPECT_EQ(shown(t), (std::vector{kFirst, kBefore, kBefore, kBefore, kBefore, kAfter}));
  }
}

TEST(Timeline, BoundsTheModesThatAreAhead) {
  Timeline t;
  ASSERT_TRUE(add(t, 0, 3));
  const auto far = t.release(kMaxWaitingPictures + 3, modes(1));
  ASSERT_FALSE(far);
  EXPECT_EQ(far.error().code, ErrorCode::kTooLarge);
  EXPECT_FALSE(t.has_next()) << "nothing happened";
  ASSERT_TRUE(t.release(kMaxWaitingPictures + 2, modes(1, kAfter)));
  EXPECT_EQ(shown(t), std::vector(3, kFirst));
}

TEST(Timeline, KnowsWhichStatesAreGuesses) {
  Timeline t;
  ASSERT_TRUE(add(t, 0, 3));
  ASSERT_TRUE(add(t, 3, 5, 2));
  for (int i = 0; i < 8; ++i) EXPECT_EQ(t.find(i)->guessed, i == 3 || i == 4) << i;
}

TEST(Timeline, FindsWaitingPictures) {
  Timeline t;
  ASSERT_TRUE(add(t, 0, 20));
  for (int i = 0; i < 20; ++i) {
    ASSERT_NE(t.find(i), nullptr);
    EXPECT_EQ(t.find(i)->state.pose[kYaw], i);
  }
  EXPECT_EQ(t.find(20), nullptr);
  EXPECT_EQ(t.find(-1), nullptr);
  EXPECT_EQ(Timeline().find(0), nullptr);
}

TEST(Timeline, KeepsTheLastDisplayedPicturesAndNoMore) {
  Timeline t;
  const int count = 3 * kKeptPictures;
  ASSERT_TRUE(add(t, 0, count));
  t.release_all();
  for (int i = 0; i < count; ++i) {
    t.next();
    const int oldest = std::max(0, i + 1 - kKeptPictures);
    ASSERT_NE(t.find(oldest), nullptr) << i;
    EXPECT_EQ(t.find(oldest)->state.pose[kYaw], oldest);
    EXPECT_EQ(t.find(oldest - 1), nullptr) << i;
  }
}

TEST(Timeline, BoundsThePicturesThatWait) {
  Timeline t;
  for (int n = 0; n < kMaxWaitingPictures; n += kMaxGroupPictures) ASSERT_TRUE(add(t, n, kMaxGroupPictures));
  const auto more = add(t, kMaxWaitingPictures, 1);
  ASSERT_FALSE(more);
  EXPECT_EQ(more.error().code, ErrorCode::kTooLarge);
  ASSERT_TRUE(t.release(0, modes(1)));
  t.next();
  EXPECT_TRUE(add(t, kMaxWaitingPictures, 1)) << "one has gone";
  EXPECT_FALSE(add(t, kMaxWaitingPictures + 1, 1));
}

TEST(Timeline, GoesOnAtAnotherPosition) {
  Timeline t({100, 5000}, 3);
  ASSERT_TRUE(add(t, 3, 4));  // they last 3, 4, 5 and 6
  ASSERT_TRUE(t.release(3, modes(2)));
  for (int i = 0; i < 2; ++i) EXPECT_EQ(t.next().position.pictures, 100U + static_cast<unsigned>(i));
  EXPECT_EQ(t.find(5)->position, (StreamPosition{102, 5007}));
  t.go_on({200, 9000});
  ASSERT_TRUE(add(t, 7, 1));
  EXPECT_EQ(t.find(4)->position, (StreamPosition{101, 5003})) << "it has been displayed before";
  EXPECT_EQ(t.find(5)->position, (StreamPosition{200, 9000}));
  EXPECT_EQ(t.find(6)->position, (StreamPosition{201, 9005}));
  EXPECT_EQ(t.find(7)->position, (StreamPosition{202, 9011}));
  EXPECT_EQ(t.end_time(), 9018U);
}

}  // namespace
}  // namespace fbs
