#include "bitstream/motion/duration_coder.h"

#include <gtest/gtest.h>

#include <vector>

#include "bitstream/entropy/bit_counter.h"
#include "bitstream/entropy/range_coder.h"

namespace fbs {
namespace {

std::vector<std::uint8_t> coded(const std::vector<std::uint32_t>& durations, DurationHistory history) {
  RangeEncoder encoder;
  DurationContexts contexts;
  for (const std::uint32_t d : durations) EXPECT_TRUE(code_duration(encoder, contexts, history, d));
  return encoder.finish();
}

TEST(DurationCoder, RoundTripsLastSecondLastAndAnyOther) {
  const std::vector<std::uint32_t> durations = {3000, 3000,         2970,         3000, 2970,
                                                1,    kMaxDuration, kMaxDuration, 1};
  const auto bytes = coded(durations, {3000, 3000});
  RangeDecoder decoder(bytes);
  DurationContexts contexts;
  DurationHistory history{3000, 3000};
  for (const std::uint32_t expected : durations) {
    std::uint32_t read = 0;
    ASSERT_TRUE(code_duration(decoder, contexts, history, read));
    EXPECT_EQ(read, expected);
  }
  EXPECT_EQ(history.last, 1u);
  EXPECT_EQ(history.second_last, kMaxDuration);
  EXPECT_TRUE(decoder.ok() && decoder.at_end());
}

TEST(DurationCoder, AlternatingDurationsAreCheap) {
  BitCounter counter;
  DurationContexts contexts;
  DurationHistory history{3000, 3060};
  for (int i = 0; i < 100; ++i) {
    const std::uint32_t value = i % 2 == 0 ? 3060 : 3000;
    ASSERT_TRUE(code_duration(counter, contexts, history, value));
  }
  EXPECT_LT(counter.bits_x256(), 30u * 256);
}

// SPEC 5.5: only 1..kMaxDuration is valid.
TEST(DurationCoder, RefusesASumOutOfRange) {
  const auto largest = coded({kMaxDuration}, {1, 1});
  for (const std::uint32_t last : {1u, 2u}) {
    RangeDecoder decoder(largest);
    DurationContexts contexts;
    DurationHistory history{last, last};
    std::uint32_t read = 0;
    EXPECT_EQ(code_duration(decoder, contexts, history, read), last == 1) << last;
  }
}

}  // namespace
}  // namespace fbs
