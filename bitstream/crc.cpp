#include "bitstream/crc.h"

namespace fbs {

std::uint32_t Crc::of(std::span<const std::uint8_t> data, std::uint32_t start) const {
  std::uint32_t value = start;
  for (const std::uint8_t byte : data)
    value = (value << 8 & mask()) ^ table_[(value >> (bits_ - 8) ^ byte) & 0xFF];
  return value;
}

std::optional<std::size_t> Crc::wrong_bit(std::uint32_t difference, std::size_t count) const {
  std::uint32_t of_bit = 1;
  for (std::size_t bit = 0; bit < count; ++bit, of_bit = shift(of_bit))
    if (of_bit == difference) return bit;
  return std::nullopt;
}

}  // namespace fbs
