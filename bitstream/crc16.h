// CRC-16/CCITT-FALSE: polynomial 0x1021, initial value 0xFFFF, not reflected, no final xor. SPEC 3.1.
// The check of the ASCII digits "123456789" is 0x29B1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace fbs {

inline constexpr std::uint16_t kCrc16Start = 0xFFFF;

/// Continues `crc` over `data`; crc16(b, crc16(a)) is the check of a followed by b.
[[nodiscard]] std::uint16_t crc16(std::span<const std::uint8_t> data, std::uint16_t crc = kCrc16Start);

}  // namespace fbs
