#include "bitstream/crc16.h"

#include <array>

namespace fbs {
namespace {

constexpr std::uint32_t kPolynomial = 0x11021;

constexpr std::array<std::uint16_t, 256> make_table() {
  std::array<std::uint16_t, 256> table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte << 8;
    for (int bit = 0; bit < 8; ++bit) {
      crc <<= 1;
      if ((crc & 0x10000u) != 0) crc ^= kPolynomial;
    }
    table[byte] = static_cast<std::uint16_t>(crc);
  }
  return table;
}

constexpr std::array<std::uint16_t, 256> kTable = make_table();

}  // namespace

std::uint16_t crc16(std::span<const std::uint8_t> data, std::uint16_t crc) {
  unsigned value = crc;
  for (const std::uint8_t byte : data) value = (value << 8 & 0xFFFFu) ^ kTable[(value >> 8) ^ byte];
  return static_cast<std::uint16_t>(value);
}

}  // namespace fbs
