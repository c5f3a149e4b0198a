#include "bitstream/crc.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace fbs {
namespace {

constexpr std::array<std::uint8_t, 9> kDigits = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};

TEST(Crc, HasTheCheckValuesOfCatalogues) {
  EXPECT_EQ(kCrc16.of(kDigits, 0xFFFF), 0x29B1U);
  EXPECT_EQ(kCrc24.of(kDigits, 0xB704CE), 0x21CF02U);
  EXPECT_EQ(kCrc24.of(kDigits, 0xFFFFFF), 0xC3A394U);
}

TEST(Crc, GoesOnBehindWhatWasChecked) {
  const std::span digits(kDigits);
  for (const Crc& crc : {kCrc16, kCrc24})
    EXPECT_EQ(crc.of(digits.subspan(4), crc.of(digits.first(4), 5)), crc.of(digits, 5));
}

TEST(Crc, TellsWhichBitIsWrong) {
  for (const Crc& crc : {kCrc16, kCrc24}) {
    std::vector<std::uint8_t> data(200, 0x5A);
    const std::uint32_t check = crc.of(data, 1);
    const std::size_t bits = 8 * data.size() + crc.bits();
    for (std::size_t bit = 0; bit < 8 * data.size(); ++bit) {
      std::uint8_t& byte = data[data.size() - 1 - bit / 8];
      byte = static_cast<std::uint8_t>(byte ^ 1U << bit % 8);
      EXPECT_EQ(crc.wrong_bit(crc.of(data, 1) ^ check, bits), bit + crc.bits());
      byte = static_cast<std::uint8_t>(byte ^ 1U << bit % 8);
    }
    for (std::size_t bit = 0; bit < crc.bits(); ++bit)
      EXPECT_EQ(crc.wrong_bit(std::uint32_t{1} << bit, bits), bit) << "in the check";
  }
}

TEST(Crc, NeverTakesTwoWrongBitsForOne) {
  for (const Crc& crc : {kCrc16, kCrc24})
    for (std::size_t bit = 1; bit < 400; ++bit) {
      std::vector<std::uint8_t> wrong(50);
      wrong[0] = 1;
      wrong[bit / 8] = static_cast<std::uint8_t>(wrong[bit / 8] ^ 1U << bit % 8);
      EXPECT_FALSE(crc.wrong_bit(crc.of(wrong, 0), 400 + crc.bits())) << bit;
    }
}

}  // namespace
}  // namespace fbs
