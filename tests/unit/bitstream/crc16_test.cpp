#include "bitstream/crc16.h"

#include <gtest/gtest.h>

#include <array>

namespace fbs {
namespace {

TEST(Crc16, HasTheCatalogueCheckValue) {
  const std::array<std::uint8_t, 9> digits = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(crc16(digits), 0x29B1);
  EXPECT_EQ(crc16(std::span(digits).subspan(4), crc16(std::span(digits).first(4))), 0x29B1);
}

}  // namespace
}  // namespace fbs
