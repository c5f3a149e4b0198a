#include "bitstream/crc16.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace fbs {
namespace {

TEST(Crc16, HasTheCatalogueCheckValue) {
  const std::array<std::uint8_t, 9> digits = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(crc16(digits), 0x29B1);
  EXPECT_EQ(crc16(std::span(digits).subspan(4), crc16(std::span(digits).first(4))), 0x29B1);
}

TEST(Crc16, SkipsZeroBytesAsIfTheyWereRead) {
  for (const std::size_t count : {0u, 1u, 2u, 255u, 4097u}) {
    const std::vector<std::uint8_t> zeros(count, 0);
    EXPECT_EQ(crc16_skip(0xBEEF, count), crc16(zeros, 0xBEEF)) << count;
  }
}

}  // namespace
}  // namespace fbs
