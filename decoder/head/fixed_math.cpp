#include "decoder/head/fixed_math.h"

#include <algorithm>
#include <bit>

#include "common/state.h"

namespace fbs {
namespace {

constexpr std::int32_t kQuarterTurn = 1 << 14;

/// Table entry at index / 2^fraction_bits, linear between entries.
std::int32_t interpolate(const std::array<std::int32_t, 257>& table, std::int32_t index, int fraction_bits) {
  const std::int32_t i = index >> fraction_bits;
  const std::int32_t f = index & ((1 << fraction_bits) - 1);
  if (f == 0) return table[i];
  const std::int32_t a = table[i];
  const std::int32_t b = table[static_cast<std::size_t>(i) + 1];
  return a + static_cast<std::int32_t>(round_shift(std::int64_t{b - a} * f, fraction_bits));
}

}  // namespace

std::int32_t sine(std::int32_t angle) {
  const std::int32_t a = angle & 0xffff;
  const std::int32_t within = a & (kQuarterTurn - 1);
  switch (a >> 14) {
    case 0:
      return interpolate(kSineTable, within, 6);
    case 1:
      return interpolate(kSineTable, kQuarterTurn - within, 6);
    case 2:
      return -interpolate(kSineTable, within, 6);
    default:
      return -interpolate(kSineTable, kQuarterTurn - within, 6);
  }
}

std::int32_t cosine(std::int32_t angle) {
  return sine((angle & 0xffff) + kQuarterTurn);
}

std::int64_t exp2_q16(std::int32_t exponent) {
  const std::int32_t e = std::clamp(exponent, 0, kMaxLogScale);
  return std::int64_t{interpolate(kExp2Table, e & 4095, 4)} << (e >> 12);
}

std::int32_t log2_fixed(std::uint64_t x) {
  constexpr int kDigits = 12, kMantissaLog2 = 31;
  const int whole = static_cast<int>(std::bit_width(x)) - 1;
  std::uint64_t mantissa =
      whole > kMantissaLog2 ? x >> (whole - kMantissaLog2) : x << (kMantissaLog2 - whole);
  std::int32_t digits = whole;
  for (int i = 0; i < kDigits; ++i) {  // squaring yields one binary digit after another
    mantissa = mantissa * mantissa >> kMantissaLog2;
    const bool two = mantissa >> (kMantissaLog2 + 1) != 0;
    if (two) mantissa >>= 1;
    digits = digits << 1 | static_cast<std::int32_t>(two);
  }
  return digits;
}

}  // namespace fbs
