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

/// Continues `crc` over `zero_bytes` bytes of zero in O(log zero_bytes). The check is linear over GF(2):
/// check(a..b) = check0(0..b) ^ crc16_skip(check0(0..a) ^ start, b - a), where check0 starts at 0. So the
/// search for packets in damaged streams tests many ranges in one pass.
[[nodiscard]] std::uint16_t crc16_skip(std::uint16_t crc, std::uint64_t zero_bytes);

}  // namespace fbs
