// Cyclic redundancy checks, high bit first, not reflected, no final xor. SPEC 3.1.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace fbs {

/// A check of `bits` bits. With a polynomial that has the factor x + 1 and else is primitive it also tells
/// which bit is wrong, if one is, in data of up to 2^(bits - 1) - 1 bits with their check.
class Crc {
 public:
  /// @param bits        8..24
  /// @param polynomial  without its highest term
  constexpr Crc(unsigned bits, std::uint32_t polynomial) : bits_(bits), polynomial_(polynomial) {
    for (std::uint32_t byte = 0; byte < table_.size(); ++byte) {
      table_[byte] = byte << (bits - 8);
      for (int bit = 0; bit < 8; ++bit) table_[byte] = shift(table_[byte]);
    }
  }

  [[nodiscard]] constexpr unsigned bits() const { return bits_; }
  /// The check of data, which begins with `start` in place of what was before.
  [[nodiscard]] std::uint32_t of(std::span<const std::uint8_t> data, std::uint32_t start) const;
  /// Which bit of data and check behind them is wrong, if it is one.
  /// @param difference  check of the data xor the check that came with them, not 0
  /// @param count       bits of data and check
  /// @return            counted from the last bit of the check; nothing if more than one is wrong
  [[nodiscard]] std::optional<std::size_t> wrong_bit(std::uint32_t difference, std::size_t count) const;

 private:
  [[nodiscard]] constexpr std::uint32_t shift(std::uint32_t value) const {
    value <<= 1;
    return value >> bits_ != 0 ? (value ^ polynomial_) & mask() : value;
  }
  [[nodiscard]] constexpr std::uint32_t mask() const { return (std::uint32_t{1} << bits_) - 1; }

  unsigned bits_;
  std::uint32_t polynomial_;
  std::array<std::uint32_t, 256> table_{};
};

inline constexpr Crc kCrc16(16, 0x1021);    ///< CRC-16/CCITT-FALSE if it starts with 0xFFFF
inline constexpr Crc kCrc24(24, 0x864CFB);  ///< the polynomial of RFC 9580

}  // namespace fbs
