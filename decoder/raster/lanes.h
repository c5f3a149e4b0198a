// Eight samples at once: vectors of GCC and Clang, which need no library and exist on every machine's
// baseline (SSE2, NEON, WebAssembly). Integers only.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace fbs {

inline constexpr int kLaneCount = 8;

/// One sample, or a share of one, in each lane. Arithmetic is modulo 2^16.
using Lanes = std::uint16_t __attribute__((vector_size(2 * kLaneCount)));

/// Half as many numbers of twice the size.
using WideLanes = std::uint32_t __attribute__((vector_size(2 * kLaneCount)));
using SignedWideLanes = std::int32_t __attribute__((vector_size(2 * kLaneCount)));

/// The same with a sign.
using SignedLanes = std::int16_t __attribute__((vector_size(2 * kLaneCount)));

static_assert(std::endian::native == std::endian::little);  // for the order of bytes in lanes

/// Eight samples.
[[nodiscard]] inline Lanes load_lanes(const std::uint8_t* samples) {
  using Words = std::uint64_t __attribute__((vector_size(2 * kLaneCount)));
  using Bytes = std::uint8_t __attribute__((vector_size(2 * kLaneCount)));
  std::uint64_t word = 0;
  std::memcpy(&word, samples, sizeof word);
  const auto bytes = reinterpret_cast<Bytes>(Words{word, 0});
  // One instruction, which compilers do not make of __builtin_convertvector().
  return reinterpret_cast<Lanes>(
      __builtin_shufflevector(bytes, Bytes{}, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23));
}

/// @param pair  gives, for each lane, the address of two samples; the first will be the low byte of the lane
template <class Pair>
[[nodiscard]] inline Lanes load_pairs(Pair&& pair) {
  const auto load = [&](int lane) {
    std::uint16_t two = 0;
    std::memcpy(&two, pair(lane), sizeof two);
    return two;
  };
  return Lanes{load(0), load(1), load(2), load(3), load(4), load(5), load(6), load(7)};
}

/// Values of 0..255 as bytes in memory order.
[[nodiscard]] inline std::uint64_t bytes_of(Lanes lanes) {
  using HalfBytes = std::uint8_t __attribute__((vector_size(kLaneCount)));
  return std::bit_cast<std::uint64_t>(__builtin_convertvector(lanes, HalfBytes));
}

/// @param lanes  0..255
inline void store_lanes(Lanes lanes, std::uint8_t* samples) {
  const std::uint64_t bytes = bytes_of(lanes);
  std::memcpy(samples, &bytes, sizeof bytes);
}

/// Stores the first lanes only; the samples behind them, which must be there, keep their values. Without a
/// branch: counts are hard to predict.
/// @param count  1..kLaneCount
inline void store_first_lanes(Lanes lanes, std::uint8_t* samples, int count) {
  const std::uint64_t mask = ~std::uint64_t{0} >> (8 * (kLaneCount - count));
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, samples, sizeof bytes);
  bytes = (bytes & ~mask) | (bytes_of(lanes) & mask);
  std::memcpy(samples, &bytes, sizeof bytes);
}

[[nodiscard]] inline std::array<SignedWideLanes, 2> widen(Lanes lanes) {
  // The zeros in this order: compilers make one instruction of an interleave.
  return {
      reinterpret_cast<SignedWideLanes>(__builtin_shufflevector(lanes, Lanes{}, 0, 8, 1, 9, 2, 10, 3, 11)),
      reinterpret_cast<SignedWideLanes>(__builtin_shufflevector(lanes, Lanes{}, 4, 12, 5, 13, 6, 14, 7, 15))};
}

/// @param halves  values of sixteen bits
[[nodiscard]] inline SignedLanes narrow(const std::array<SignedWideLanes, 2>& halves) {
  const auto low = reinterpret_cast<SignedLanes>(halves[0]), high = reinterpret_cast<SignedLanes>(halves[1]);
  return __builtin_shufflevector(low, high, 0, 2, 4, 6, 8, 10, 12, 14);
}

/// @param halves  values of sixteen bits, which are clamped to 0..255
[[nodiscard]] inline Lanes narrow_clamped(const std::array<SignedWideLanes, 2>& halves) {
  SignedLanes lanes = narrow(halves);
  lanes = lanes < 0 ? SignedLanes{} : lanes;
  lanes = lanes > 255 ? SignedLanes{} + std::int16_t{255} : lanes;
  return reinterpret_cast<Lanes>(lanes);
}

/// The upper sixteen bits of each product.
[[nodiscard, gnu::always_inline]] inline Lanes multiply_high(Lanes a, Lanes b) {
  using Array = std::array<std::uint16_t, kLaneCount>;
  const auto x = std::bit_cast<Array>(a), y = std::bit_cast<Array>(b);
  Array out;
#ifndef __clang__
#pragma GCC unroll 1  // left whole, the loop becomes one instruction (PMULHUW)
#endif
  for (int i = 0; i < kLaneCount; ++i) out[i] = static_cast<std::uint16_t>(std::uint32_t{x[i]} * y[i] >> 16);
  return std::bit_cast<Lanes>(out);
}

/// All bits of each product.
[[nodiscard, gnu::always_inline]] inline std::array<SignedWideLanes, 2> multiply_wide(SignedLanes a,
                                                                                      SignedLanes b) {
  using Array = std::array<std::int16_t, kLaneCount>;
  const auto x = std::bit_cast<Array>(a), y = std::bit_cast<Array>(b);
  std::array<std::int32_t, kLaneCount> out;
#ifndef __clang__
#pragma GCC unroll 1  // as above (PMULLW and PMULHW)
#endif
  for (int i = 0; i < kLaneCount; ++i) out[i] = std::int32_t{x[i]} * y[i];
  return std::bit_cast<std::array<SignedWideLanes, 2>>(out);
}

/// 0, step, 2 * step, ... modulo 2^16.
[[nodiscard]] inline Lanes multiples(std::int64_t step) {
  constexpr Lanes kNumbers = {0, 1, 2, 3, 4, 5, 6, 7};
  return kNumbers * static_cast<std::uint16_t>(step);
}

}  // namespace fbs
