#include "bitstream/byte_io.h"

#include <gtest/gtest.h>

#include <limits>

namespace fbs {
namespace {

TEST(ByteIo, RoundTripsVarints) {
  for (const std::uint64_t value :
       {std::uint64_t{0}, std::uint64_t{127}, std::uint64_t{128}, std::uint64_t{300}, std::uint64_t{1} << 32,
        std::numeric_limits<std::uint64_t>::max()}) {
    std::vector<std::uint8_t> bytes;
    ByteWriter(bytes).varint(value);
    ByteReader reader(bytes);
    EXPECT_EQ(reader.varint(), value);
    EXPECT_TRUE(reader.ok());
    EXPECT_EQ(reader.remaining(), 0u);
  }
}

TEST(ByteIo, ReportsReadPastEnd) {
  const std::vector<std::uint8_t> bytes = {7, 0x80};
  ByteReader reader(bytes);
  EXPECT_EQ(reader.u8(), 7);
  EXPECT_TRUE(reader.ok());
  EXPECT_EQ(reader.varint(), 0u);
  EXPECT_TRUE(reader.past_end());
  EXPECT_FALSE(reader.malformed());
  EXPECT_EQ(reader.u8(), 0);
  EXPECT_TRUE(reader.bytes(0).empty());
  EXPECT_TRUE(reader.past_end());
}

TEST(ByteIo, ComparesSizesWithoutOverflow) {
  const std::vector<std::uint8_t> bytes = {1, 2, 3};
  ByteReader reader(bytes);
  EXPECT_EQ(reader.u8(), 1);
  EXPECT_TRUE(reader.bytes(std::numeric_limits<std::size_t>::max()).empty());
  EXPECT_TRUE(reader.past_end());
}

TEST(ByteIo, RefusesVarintsBeyond64BitsOrPadded) {
  const std::vector<std::uint8_t> large = {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x02};
  ByteReader reader(large);
  EXPECT_EQ(reader.varint(), 0u);
  EXPECT_TRUE(reader.malformed());
  const std::vector<std::uint8_t> endless(11, 0x80);
  ByteReader second(endless);
  EXPECT_EQ(second.varint(), 0u);
  EXPECT_TRUE(second.malformed());
  const std::vector<std::uint8_t> padded = {0x81, 0x00};
  ByteReader third(padded);
  EXPECT_EQ(third.varint(), 0u);
  EXPECT_TRUE(third.malformed());
}

}  // namespace
}  // namespace fbs
