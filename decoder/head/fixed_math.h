// Sine and power of two in integers, so that every machine draws the same picture. SPEC 9.1.
#pragma once

#include <array>
#include <cstdint>

namespace fbs {

inline constexpr int kRotationOneLog2 = 14;  ///< sine, cosine and rotation matrices: 1.0 == 1 << 14
inline constexpr int kScaleOneLog2 = 16;     ///< scale factors: 1.0 == 1 << 16

extern const std::array<std::int32_t, 257> kSineTable;  ///< first quarter of the sine, Q14
extern const std::array<std::int32_t, 257> kExp2Table;  ///< 2^0 .. 2^1, Q16

/// Right shift with rounding to nearest, halves upwards.
[[nodiscard]] constexpr std::int64_t round_shift(std::int64_t value, int bits) {
  return (value + (std::int64_t{1} << (bits - 1))) >> bits;
}

/// Sine in Q14 of an angle in 2^-16 turns; any angle.
[[nodiscard]] std::int32_t sine(std::int32_t angle);

/// Cosine in Q14 of an angle in 2^-16 turns; any angle.
[[nodiscard]] std::int32_t cosine(std::int32_t angle);

/// 2^(exponent / 4096) in Q16, for 0 <= exponent <= 13 * 4096; clamped outside.
[[nodiscard]] std::int64_t exp2_q16(std::int32_t exponent);

/// log2(x) in 1/4096, rounded down; x > 0. SPEC 9.1.
[[nodiscard]] std::int32_t log2_fixed(std::uint64_t x);

}  // namespace fbs
