// Signed integers over the binary range coder: zero flag, sign, magnitude. SPEC 2.4.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>

#include "bitstream/entropy/adaptive_bit.h"

namespace fbs {

inline constexpr int kMaxExponent = 23;
/// Largest value that code_exponential can write.
inline constexpr std::uint32_t kMaxExponential = (std::uint32_t{2} << kMaxExponent) - 2;

/// Contexts of an Exp-Golomb number: for each place of the unary exponent, and for the highest bit of the
/// mantissa. Lower bits are coded without a context.
struct ExponentialContexts {
  std::array<AdaptiveBit, kMaxExponent> more;
  std::array<AdaptiveBit, 4> top_bit;  ///< by exponent 1, 2, 3, beyond
};

/// Exp-Golomb of order 0: value + 1 = 2^exponent + mantissa.
/// @param value  0..kMaxExponential; a reader stays in this range whatever the bytes are
template <class Coder>
std::uint32_t code_exponential(Coder& coder, ExponentialContexts& contexts, std::uint32_t value) {
  if constexpr (Coder::kReads) value = 0;
  assert(value <= kMaxExponential);
  int exponent = 0;
  while (exponent < kMaxExponent && coder.bit(contexts.more[exponent], (value + 1) >> (exponent + 1) != 0)) {
    ++exponent;
  }
  std::uint32_t mantissa = value + 1 - (std::uint32_t{1} << exponent);
  if (exponent > 0) {
    const int place = std::min(exponent, 4) - 1;
    const std::uint32_t top = coder.bit(contexts.top_bit[place], (mantissa >> (exponent - 1) & 1) != 0);
    mantissa = top << (exponent - 1) | coder.bypass(exponent - 1, mantissa & ((1u << (exponent - 1)) - 1));
  }
  return (std::uint32_t{1} << exponent) + mantissa - 1;
}

/// Contexts of a number without a good prediction, such as one in a state coded whole.
struct WideIntegerContexts {
  AdaptiveBit not_zero;
  AdaptiveBit negative;
  ExponentialContexts magnitude;
};

/// @param value  |value| <= kMaxExponential; a reader may return one more
template <class Coder>
std::int32_t code_wide_integer(Coder& coder, WideIntegerContexts& contexts, std::int32_t value) {
  if (!coder.bit(contexts.not_zero, value != 0)) return 0;
  const bool negative = coder.bit(contexts.negative, value < 0);
  const auto size = static_cast<std::uint32_t>(value < 0 ? -value : value);
  const auto magnitude = static_cast<std::int32_t>(code_exponential(coder, contexts.magnitude, size - 1)) + 1;
  return negative ? -magnitude : magnitude;
}

}  // namespace fbs
