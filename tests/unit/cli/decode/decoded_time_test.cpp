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

// An encoder lets rounded durations run away from the source by up to 5 ms.
TEST(DecodedTime, MakingGoodTheRoundingOfDurationsIsNoDrift) {
  const Rational rate{24000, 1001};
  DecodedTime time(rate);
  std::int64_t stream = 0;
  for (int i = 1; i <= 240000; ++i) {
    const std::int64_t right = regular_pts(i, rate), ahead = stream + nominal_duration(rate) - right;
    const auto duration = ahead <= 450 ? nominal_duration(rate) : static_cast<std::uint32_t>(right - stream);
    stream += duration;
    time.advance(duration);
    ASSERT_EQ(time.pts(), right) << i;
  }
}

TEST(DecodedTime, OtherDurationsLeadToTheTimeOfTheStream) {
  const Rational rate{24000, 1001};
  DecodedTime time(rate);
  for (int i = 0; i < 100; ++i) time.advance(nominal_duration(rate));
  time.advance(10000);
  EXPECT_EQ(time.pts(), 100 * nominal_duration(rate) + 10000);
}

// Counted time may be ahead of the stream's.
TEST(DecodedTime, NeverGoesBack) {
  const Rational rate{7, 1};  // 12857.14 ticks
  DecodedTime time(rate);
  for (int i = 0; i < 3000; ++i) time.advance(nominal_duration(rate));
  const std::int64_t before = time.pts();
  time.advance(1);
  EXPECT_GT(time.pts(), before);
}

}  // namespace
}  // namespace fbs::cli
