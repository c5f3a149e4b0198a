#include "bitstream/entropy/adaptive_integer.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "bitstream/entropy/range_coder.h"

namespace fbs {
namespace {

TEST(AdaptiveInteger, RoundTripsAllSizes) {
  std::vector<std::int32_t> values = {0, 1, -1, 2, -7, 255, -256, 1 << 20, -(1 << 22)};
  values.push_back(static_cast<std::int32_t>(kMaxExponential));
  RangeEncoder encoder;
  WideIntegerContexts contexts;
  for (const std::int32_t v : values) code_wide_integer(encoder, contexts, v);
  const auto bytes = encoder.finish();
  RangeDecoder decoder(bytes);
  contexts = {};
  for (const std::int32_t v : values) EXPECT_EQ(code_wide_integer(decoder, contexts, 0), v);
}

TEST(AdaptiveInteger, StaysBoundedOnArbitraryBytes) {
  std::mt19937 random(9);
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::uint8_t> bytes(12);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random() % 8 == 0 ? random() : 0xFF);
    RangeDecoder decoder(bytes);
    ExponentialContexts contexts;
    for (int k = 0; k < 8; ++k) EXPECT_LE(code_exponential(decoder, contexts, 0), kMaxExponential);
  }
}

}  // namespace
}  // namespace fbs
