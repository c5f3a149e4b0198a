#include "bitstream/sound_time.h"

#include <gtest/gtest.h>

#include "bitstream/syntax.h"

namespace fbs {
namespace {

TEST(SoundTime, IsThatOfThePicturesRoundedDown) {
  EXPECT_EQ(sound_time(0), 0);
  EXPECT_EQ(sound_time(kTicksPerSecond), kSoundClock);
  EXPECT_EQ(sound_time(3000), 1600);
  EXPECT_EQ(sound_time(14), 7);  // 7.47
}

TEST(SoundTime, OfTheLongestStreamFits) {
  constexpr auto kMost = static_cast<std::int64_t>(kMaxStreamTime);
  EXPECT_EQ(sound_time(kMost), kMost / 15 * 8 + kMost % 15 * 8 / 15);
}

}  // namespace
}  // namespace fbs
