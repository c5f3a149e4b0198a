#include "cli/decode/decoded_time.h"

#include <gtest/gtest.h>

namespace fbs::cli {
namespace {

TEST(DecodedTime, PicturesOfTheFrameRateDoNotDrift) {
  const Rational rate{24000, 1001};  // 3753.75 ticks
  DecodedTime time(rate);
  for (int i = 0; i < 24000; ++i) time.advance(nominal_duration(rate));
  EXPECT_EQ(time.pts(), 1001 * kTicksPerSecond);
}

TEST(DecodedTime, OtherDurationsAddUp) {
  DecodedTime time({25, 1});
  EXPECT_EQ(time.pts(), 0);
  time.advance(5000);
  EXPECT_EQ(time.pts(), 5000);
  time.advance(3600);
  time.advance(1);
  EXPECT_EQ(time.pts(), 8601);
}

}  // namespace
}  // namespace fbs::cli
