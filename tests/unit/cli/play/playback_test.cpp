#include "cli/play/playback.h"

#include <gtest/gtest.h>

#include "common/picture.h"

namespace fbs::cli {
namespace {

using namespace std::chrono_literals;

constexpr std::uint32_t kTenth = kTicksPerSecond / 10;
const Playback::Time kStart{100s};

/// Pictures that last a tenth of a second; number 0 was taken at kStart.
Playback begun() {
  Playback playback;
  playback.take(0, kTenth, kStart);
  return playback;
}

TEST(Playback, NextPictureIsDueWhenThisOneHasLasted) {
  const Playback playback = begun();
  EXPECT_FALSE(playback.is_due(kStart + 99ms));
  EXPECT_TRUE(playback.is_due(kStart + 100ms));
  EXPECT_EQ(playback.until_due(kStart + 30ms), 70ms);
}

TEST(Playback, DelaysDoNotAddUp) {
  Playback playback = begun();
  for (int k = 1; k <= 20; ++k)
    playback.take(static_cast<std::uint64_t>(k) * kTenth, kTenth, kStart + k * 100ms + 40ms);
  EXPECT_EQ(playback.until_due(kStart + 2s), 100ms);
}

TEST(Playback, PauseHoldsThePictureAndItsTime) {
  Playback playback = begun();
  playback.pause(true, kStart + 30ms);
  EXPECT_FALSE(playback.is_due(kStart + 10s));
  playback.pause(false, kStart + 10s);
  EXPECT_FALSE(playback.is_due(kStart + 10s + 99ms));
  EXPECT_TRUE(playback.is_due(kStart + 10s + 100ms));
}

TEST(Playback, LatePictureIsLeftOutUntilOneMustBeDrawn) {
  Playback playback = begun();
  playback.drawn(kStart);
  playback.take(kTenth, kTenth, kStart + 150ms);
  EXPECT_FALSE(playback.is_late(kStart + 199ms));
  EXPECT_FALSE(playback.is_late(kStart + 200ms)) << "the last was drawn long ago";
  playback.drawn(kStart + 150ms);
  EXPECT_TRUE(playback.is_late(kStart + 210ms));
}

TEST(Playback, NothingIsLateWhilePaused) {
  Playback playback = begun();
  playback.drawn(kStart + 990ms);
  playback.pause(true, kStart);
  playback.take(kTenth, kTenth, kStart + 1s);
  EXPECT_FALSE(playback.is_late(kStart + 1s));
}

TEST(Playback, StreamThatIsFarBehindIsSlowedDown) {
  Playback playback = begun();
  playback.take(kTenth, kTenth, kStart + 5s);
  EXPECT_FALSE(playback.is_due(kStart + 5s));
  EXPECT_TRUE(playback.is_due(kStart + 5s + 100ms));
}

TEST(Playback, JumpShowsThePictureAtOnceAndGoesOnFromThere) {
  Playback playback = begun();
  playback.jump();
  playback.take(50 * kTenth, kTenth, kStart + 20ms);
  EXPECT_EQ(playback.until_due(kStart + 20ms), 100ms);
}

TEST(Playback, GapOfLostPicturesIsNotWaitedFor) {
  Playback playback = begun();
  playback.take(80 * kTenth, kTenth, kStart + 100ms);
  EXPECT_TRUE(playback.is_due(kStart + 200ms));
}

TEST(Playback, NothingIsDueBehindTheEnd) {
  Playback playback = begun();
  playback.end();
  EXPECT_FALSE(playback.is_due(kStart + 10s));
  playback.jump();
  playback.take(0, kTenth, kStart + 10s);
  EXPECT_TRUE(playback.is_due(kStart + 10s + 100ms));
}

TEST(Playback, PicturesFollowAnotherClock) {
  Playback playback = begun();
  playback.follow(kTenth / 2, kStart + 90ms);
  EXPECT_EQ(playback.until_due(kStart + 90ms), 50ms);
  playback.follow(kTenth / 2, kStart + 500ms);  // it stood still
  EXPECT_EQ(playback.until_due(kStart + 500ms), 50ms);
  playback.follow(kTenth, kStart + 510ms);
  EXPECT_TRUE(playback.is_due(kStart + 510ms));
}

TEST(Playback, AnotherClockIsNotSlowedDown) {
  Playback playback = begun();
  playback.drawn(kStart);
  playback.follow(20 * kTenth, kStart + 100ms);
  playback.take(kTenth, kTenth, kStart + 110ms);
  EXPECT_TRUE(playback.is_due(kStart + 110ms));
  EXPECT_TRUE(playback.is_late(kStart + 110ms));
  playback.jump();
  playback.take(50 * kTenth, kTenth, kStart + 120ms);
  EXPECT_EQ(playback.until_due(kStart + 120ms), 100ms) << "after a jump it has to be followed anew";
  playback.take(51 * kTenth, kTenth, kStart + 5s);
  EXPECT_FALSE(playback.is_due(kStart + 5s)) << "without it, a stream is slowed down";
}

TEST(ClockText, IsWhatPlayersWrite) {
  EXPECT_EQ(clock_text(0), "0:00.00");
  EXPECT_EQ(clock_text(kTicksPerSecond * 61 + kTicksPerSecond / 4), "1:01.25");
  EXPECT_EQ(clock_text(std::uint64_t{kTicksPerSecond} * 3723), "1:02:03.00");
}

}  // namespace
}  // namespace fbs::cli
