// Eight samples at once: vectors of GCC and Clang, which need no library and map to every machine's baseline
// (SSE2, NEON, WebAssembly). Emscripten's library has no std::bit_cast yet. Integers only.
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

/// Which of the two parts of a lane is the less significant.
inline constexpr int kLowPart = std::endian::native == std::endian::little ? 0 : 1;

/// Eight samples.
[[nodiscard]] inline Lanes load_lanes(const std::uint8_t* samples) {
  using Words = std::uint64_t __attribute__((vector_size(2 * kLaneCount)));
  using Bytes = std::uint8_t __attribute__((vector_size(2 * kLaneCount)));
  std::uint64_t word = 0;
  std::memcpy(&word, samples, sizeof word);
  const auto bytes = reinterpret_cast<Bytes>(Words{word, 0});
  // One instruction, which compilers do not generate for __builtin_convertvector().
  constexpr int kA = 16 * kLowPart, kB = 16 - kA;
  return reinterpret_cast<Lanes>(__builtin_shufflevector(bytes, Bytes{}, kA, kB, kA + 1, kB + 1, kA + 2,
                                                         kB + 2, kA + 3, kB + 3, kA + 4, kB + 4, kA + 5,
                                                         kB + 5, kA + 6, kB + 6, kA + 7, kB + 7));
}

/// @param pair  gives, for each lane, the address of two samples; the first becomes the low byte of the lane
template <class Pair>
[[nodiscard]] inline Lanes load_pairs(Pair&& pair) {
  const auto load = [&](int lane) {
    std::uint16_t two = 0;
    std::memcpy(&two, pair(lane), sizeof two);
    return kLowPart == 0 ? two : __builtin_bswap16(two);
  };
  return Lanes{load(0), load(1), load(2), load(3), load(4), load(5), load(6), load(7)};
}

/// Values of 0..255 as bytes in memory order.
[[nodiscard]] inline std::uint64_t bytes_of(Lanes lanes) {
  using HalfBytes = std::uint8_t __attribute__((vector_size(kLaneCount)));
  return __builtin_bit_cast(std::uint64_t, __builtin_convertvector(lanes, HalfBytes));
}

/// @param lanes  0..255
inline void store_lanes(Lanes lanes, std::uint8_t* samples) {
  const std::uint64_t bytes = bytes_of(lanes);
  std::memcpy(samples, &bytes, sizeof bytes);
}

/// Stores the first lanes only; the samples after them, which must exist, keep their values. Branch-free:
/// counts are hard to predict.
/// @param count  1..kLaneCount
inline void store_first_lanes(Lanes lanes, std::uint8_t* samples, int count) {
  const int others = 8 * (kLaneCount - count);
  const std::uint64_t mask = kLowPart == 0 ? ~std::uint64_t{0} >> others : ~std::uint64_t{0} << others;
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, samples, sizeof bytes);
  bytes = (bytes & ~mask) | (bytes_of(lanes) & mask);
  std::memcpy(samples, &bytes, sizeof bytes);
}

[[nodiscard]] inline std::array<SignedWideLanes, 2> widen(Lanes lanes) {
  // In this order of zeros compilers emit one interleave instruction.
  constexpr int kA = 8 * kLowPart, kB = 8 - kA;
  return {reinterpret_cast<SignedWideLanes>(__builtin_shufflevector(lanes, Lanes{}, kA, kB, kA + 1, kB + 1,
                                                                    kA + 2, kB + 2, kA + 3, kB + 3)),
          reinterpret_cast<SignedWideLanes>(__builtin_shufflevector(lanes, Lanes{}, kA + 4, kB + 4, kA + 5,
                                                                    kB + 5, kA + 6, kB + 6, kA + 7, kB + 7))};
}

/// @param halves  values of sixteen bits
[[nodiscard]] inline SignedLanes narrow(const std::array<SignedWideLanes, 2>& halves) {
  const auto low = reinterpret_cast<SignedLanes>(halves[0]), high = reinterpret_cast<SignedLanes>(halves[1]);
  constexpr int kA = kLowPart;
  return __builtin_shufflevector(low, high, kA, kA + 2, kA + 4, kA + 6, kA + 8, kA + 10, kA + 12, kA + 14);
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
  const auto x = __builtin_bit_cast(Array, a), y = __builtin_bit_cast(Array, b);
  Array out;
#ifndef __clang__
#pragma GCC unroll 1  // not unrolled, the loop becomes one instruction (PMULHUW)
#endif
  for (int i = 0; i < kLaneCount; ++i) out[i] = static_cast<std::uint16_t>(std::uint32_t{x[i]} * y[i] >> 16);
  return __builtin_bit_cast(Lanes, out);
}

/// The full products.
[[nodiscard, gnu::always_inline]] inline std::array<SignedWideLanes, 2> multiply_wide(SignedLanes a,
                                                                                      SignedLanes b) {
  using Array = std::array<std::int16_t, kLaneCount>;
  const auto x = __builtin_bit_cast(Array, a), y = __builtin_bit_cast(Array, b);
  std::array<std::int32_t, kLaneCount> out;
#ifndef __clang__
#pragma GCC unroll 1  // as above (PMULLW and PMULHW)
#endif
  for (int i = 0; i < kLaneCount; ++i) out[i] = std::int32_t{x[i]} * y[i];
  return __builtin_bit_cast(std::array<SignedWideLanes, 2>, out);
}

/// 0, step, 2 * step, ... modulo 2^16.
[[nodiscard]] inline Lanes multiples(std::int64_t step) {
  constexpr Lanes kNumbers = {0, 1, 2, 3, 4, 5, 6, 7};
  return kNumbers * static_cast<std::uint16_t>(step);
}

}  // namespace fbs
