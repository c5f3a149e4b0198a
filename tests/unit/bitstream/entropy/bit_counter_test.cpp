#include "bitstream/entropy/bit_counter.h"

#include <gtest/gtest.h>

#include <random>

#include "bitstream/entropy/range_coder.h"

namespace fbs {
namespace {

TEST(BitCounter, AgreesWithTheEncoderWithinOnePercent) {
  for (const double ones : {0.003, 0.1, 0.5}) {
    std::mt19937 random(11);
    std::bernoulli_distribution one(ones);
    BitCounter counter;
    RangeEncoder encoder;
    AdaptiveBit counted_context, coded_context;
    for (int i = 0; i < 40000; ++i) {
      const bool bit = one(random);
      counter.bit(counted_context, bit);
      encoder.bit(coded_context, bit);
    }
    const double counted = static_cast<double>(counter.bits_x256()) / 256;
    const double written = static_cast<double>(encoder.finish().size()) * 8;
    EXPECT_NEAR(counted, written, written * 0.01 + 8) << ones;
  }
}

TEST(BitCounter, BypassBitsCostOneEach) {
  BitCounter counter;
  counter.bypass(7, 5);
  EXPECT_EQ(counter.bits_x256(), 7u * 256);
}

}  // namespace
}  // namespace fbs
