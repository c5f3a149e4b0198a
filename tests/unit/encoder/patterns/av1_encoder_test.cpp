#include "encoder/patterns/av1_encoder.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/encoder/patterns/scenery.h"

namespace fbs {
namespace {

Av1Settings settings_of(int quantiser, int speed, int look_ahead = 0) {
  Av1Settings s;
  s.quantiser = quantiser;
  s.speed = speed;
  s.look_ahead = look_ahead;
  return s;
}

TEST(Av1Encoder, GivesEachFrameAtOnceWithoutLookAhead) {
  auto av1 = Av1Encoder::create(format_of(64, 64), settings_of(40, 6));
  ASSERT_TRUE(av1);
  for (int i = 0; i < 3; ++i) {
    const auto frames = av1->encode(scenery(64, 64, i));
    ASSERT_TRUE(frames);
    EXPECT_EQ(frames->size(), 1U);
  }
  const auto rest = av1->finish();
  ASSERT_TRUE(rest);
  EXPECT_TRUE(rest->empty());
}

TEST(Av1Encoder, HoldsPicturesBackToLookAhead) {
  auto av1 = Av1Encoder::create(format_of(64, 64), settings_of(40, 6, 25));
  ASSERT_TRUE(av1);
  for (int i = 0; i < 9; ++i) {
    const auto frames = av1->encode(scenery(64, 64, i));
    ASSERT_TRUE(frames);
    EXPECT_TRUE(frames->empty());
  }
  const auto rest = av1->finish();
  ASSERT_TRUE(rest);
  EXPECT_GE(rest->size(), 9U) << "overlays may come on top";
}

TEST(Av1Encoder, RefusesWhatIsOutOfRange) {
  for (const Av1Settings& s :
       {settings_of(-1, 6), settings_of(64, 6), settings_of(40, -1), settings_of(40, 10)})
    EXPECT_EQ(Av1Encoder::create(format_of(64, 64), s).error().code, ErrorCode::kInvalidArgument);
  auto av1 = Av1Encoder::create(format_of(64, 64), settings_of(40, 6));
  EXPECT_EQ(av1->encode(Picture(66, 64)).error().code, ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace fbs
