#include "bitstream/entropy/range_coder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace fbs {
namespace {

std::vector<bool> skewed_bits(std::size_t count, double ones, unsigned seed) {
  std::mt19937 random(seed);
  std::bernoulli_distribution one(ones);
  std::vector<bool> bits(count);
  for (std::size_t i = 0; i < count; ++i) bits[i] = one(random);
  return bits;
}

std::vector<std::uint8_t> encode_bits(const std::vector<bool>& bits) {
  RangeEncoder encoder;
  AdaptiveBit context;
  for (const bool bit : bits) encoder.bit(context, bit);
  return encoder.finish();
}

std::vector<bool> decode_bits(std::span<const std::uint8_t> bytes, std::size_t count, bool* exact = nullptr) {
  RangeDecoder decoder(bytes);
  AdaptiveBit context;
  std::vector<bool> bits(count);
  for (std::size_t i = 0; i < count; ++i) bits[i] = decoder.bit(context);
  if (exact != nullptr) *exact = decoder.ok() && decoder.at_end();
  return bits;
}

TEST(RangeCoder, RoundTripsSkewedSymbols) {
  for (const double ones : {0.0, 0.001, 0.02, 0.3, 0.5, 0.9, 0.999, 1.0}) {
    for (const std::size_t count : {0u, 1u, 2u, 7u, 100u, 5000u}) {
      const auto bits = skewed_bits(count, ones, static_cast<unsigned>(count) + 1);
      bool exact = false;
      EXPECT_EQ(decode_bits(encode_bits(bits), count, &exact), bits) << ones << " " << count;
      EXPECT_TRUE(exact) << ones << " " << count;
    }
  }
}

// Every short message over extreme probabilities: carries, trimmed zeros and all ends occur.
TEST(RangeCoder, RoundTripsEveryShortMessageAtExtremeProbabilities) {
  constexpr std::array<std::uint32_t, 5> kZero = {1, 32, 32768, 65504, 65535};
  for (std::uint32_t message = 0; message < 1u << 12; ++message) {
    RangeEncoder encoder;
    for (std::size_t i = 0; i < 12; ++i) encoder.raw_bit(kZero[(message + i) % 5], (message >> i & 1) != 0);
    const auto bytes = encoder.finish();
    RangeDecoder decoder(bytes);
    std::uint32_t read = 0;
    for (std::size_t i = 0; i < 12; ++i) {
      read |= static_cast<std::uint32_t>(decoder.raw_bit(kZero[(message + i) % 5])) << i;
    }
    ASSERT_EQ(read, message);
    ASSERT_TRUE(decoder.ok() && decoder.at_end());
  }
}

TEST(RangeCoder, AdaptsCloseToTheEntropy) {
  for (const double ones : {0.05, 0.2, 0.5}) {
    constexpr std::size_t kCount = 50000;
    const auto bits = skewed_bits(kCount, ones, 5);
    const double share = static_cast<double>(std::count(bits.begin(), bits.end(), true)) / kCount;
    const double entropy = -(share * std::log2(share) + (1 - share) * std::log2(1 - share)) * kCount / 8;
    EXPECT_LT(static_cast<double>(encode_bits(bits).size()), entropy * 1.03) << ones;
  }
}

TEST(RangeCoder, EndsWithoutBytesWhenAllIsLikely) {
  EXPECT_EQ(encode_bits({}).size(), 0u);
  EXPECT_EQ(encode_bits(std::vector<bool>(200, false)).size(), 0u);
}

TEST(RangeCoder, EndCostsLessThanABytePastTheInformation) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const auto bits = skewed_bits(100, 0.5, seed);
    RangeEncoder encoder;
    for (const bool bit : bits) encoder.raw_bit(kProbabilityOne / 2, bit);
    EXPECT_LE(encoder.finish().size(), 14u);  // 12.5 bytes of information
  }
}

// Bytes of any value after bits of any probability: the reader is not told their number.
TEST(RangeCoder, OpenEndEndsTheLastBytes) {
  std::mt19937 random(6);
  for (int i = 0; i < 2000; ++i) {
    const auto bits = skewed_bits(i % 50, 0.1, i);
    std::vector<std::uint8_t> data(1 + random() % 30);
    for (auto& byte : data) byte = static_cast<std::uint8_t>(i % 3 == 0 ? 0 : i % 3 == 1 ? 0xFF : random());
    RangeEncoder encoder;
    AdaptiveBit writing, reading;
    for (const bool bit : bits) encoder.bit(writing, bit);
    for (const auto byte : data) encoder.bypass(8, byte);
    const auto code = encoder.finish_open();
    RangeDecoder decoder(code);
    for (const bool bit : bits) ASSERT_EQ(decoder.bit(reading), bit);
    std::vector<std::uint8_t> read;
    do {
      read.push_back(static_cast<std::uint8_t>(decoder.bypass(8)));
    } while (!decoder.past_open_end() && read.size() < 100);
    ASSERT_EQ(read, data) << i;
    ASSERT_TRUE(decoder.ok() && decoder.at_end());
  }
}

TEST(RangeCoder, DecoderReportsReadingFarPastTheEnd) {
  const std::vector<std::uint8_t> bytes = {0x5A, 0x12};
  RangeDecoder decoder(bytes);
  EXPECT_TRUE(decoder.ok());
  for (int i = 0; i < 20; ++i) decoder.bypass(8);
  EXPECT_FALSE(decoder.ok());
}

TEST(RangeCoder, EncoderKeepsZerosTheDecoderWouldMiss) {
  RangeEncoder encoder;
  for (int i = 0; i < 400; ++i) encoder.raw_bit(kProbabilityOne / 2, false);
  const auto bytes = encoder.finish();
  EXPECT_EQ(bytes.size(), 50u + 4 - kMaxVirtualBytes);
  RangeDecoder decoder(bytes);
  for (int i = 0; i < 400; ++i) EXPECT_FALSE(decoder.raw_bit(kProbabilityOne / 2));
  EXPECT_TRUE(decoder.ok() && decoder.at_end());
}

TEST(RangeCoder, DecoderRefusesBytesNoEncoderWrites) {
  const std::vector<std::uint8_t> bytes(4, 0xFF);
  EXPECT_FALSE(RangeDecoder(bytes).ok());
}

TEST(RangeCoder, NoticesBytesThatAreNotUsed) {
  auto bytes = encode_bits(skewed_bits(40, 0.3, 1));
  bytes.insert(bytes.end(), 5, 1);
  bool exact = true;
  decode_bits(bytes, 40, &exact);
  EXPECT_FALSE(exact);
}

}  // namespace
}  // namespace fbs
