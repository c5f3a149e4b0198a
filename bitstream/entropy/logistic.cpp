#include "bitstream/entropy/logistic.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

#include "bitstream/entropy/adaptive_bit.h"

namespace fbs {
namespace {

constexpr int kSteps = 256;
using Table = std::array<std::uint32_t, kSteps + 1>;

// round(65536 * log2(1 + i / 256)), by repeated squaring: each yields one more binary digit.
constexpr Table make_log_table() {
  Table table{};
  for (std::uint64_t i = 0; i < kSteps; ++i) {
    std::uint64_t x = (std::uint64_t{1} << 31) + (i << 23);  // 1..2 in 1/2^31
    std::uint32_t digits = 0;
    for (int digit = 0; digit < 17; ++digit) {
      x = x * x >> 31;
      const bool two = x >> 32 != 0;
      if (two) x >>= 1;
      digits = digits << 1 | static_cast<std::uint32_t>(two);
    }
    table[i] = (digits + 1) >> 1;
  }
  table[kSteps] = 1u << 16;
  return table;
}

constexpr std::uint64_t square_root(std::uint64_t x) {
  std::uint64_t root = 0;
  for (std::uint64_t bit = std::uint64_t{1} << 31; bit != 0; bit >>= 1) {
    if ((root | bit) * (root | bit) <= x) root |= bit;
  }
  return root;
}

// round(65536 * 2^(-i / 256)), as a product of 2^(-1/2), 2^(-1/4), ... 2^(-1/256).
constexpr Table make_power_table() {
  std::array<std::uint64_t, 8> factors{};  // 1/2^31
  std::uint64_t factor = std::uint64_t{1} << 30;
  for (auto& f : factors) f = factor = square_root(factor << 31);
  Table table{};
  for (unsigned i = 0; i < kSteps; ++i) {
    std::uint64_t product = std::uint64_t{1} << 31;
    for (unsigned bit = 0; bit < 8; ++bit) {
      if ((i >> bit & 1) != 0) product = (product * factors[7 - bit] + (1u << 30)) >> 31;
    }
    table[i] = static_cast<std::uint32_t>((product + (1u << 14)) >> 15);
  }
  table[kSteps] = 1u << 15;
  return table;
}

constexpr Table kLog2 = make_log_table();
constexpr Table kPower = make_power_table();

}  // namespace

std::uint32_t cost_of(std::uint32_t probability) {
  assert(probability > 0 && probability <= kProbabilityOne);
  const int whole = std::bit_width(probability) - 1;
  const std::uint32_t fraction = (probability << (16 - whole)) - kProbabilityOne;  // 0..65535
  const std::uint32_t index = fraction >> 8;
  const std::uint32_t between = (kLog2[index + 1] - kLog2[index]) * (fraction & 0xFF) >> 8;
  return (16u << 16) - (static_cast<std::uint32_t>(whole) << 16) - kLog2[index] - between;
}

std::int32_t stretch(std::uint32_t probability) {
  return static_cast<std::int32_t>(cost_of(kProbabilityOne - probability)) -
         static_cast<std::int32_t>(cost_of(probability));
}

std::uint32_t squash(std::int32_t log_odds) {
  constexpr std::int32_t kLimit = 12 << 16;
  const std::int32_t x = std::clamp(log_odds, -kLimit, kLimit);
  const auto size = static_cast<std::uint32_t>(x < 0 ? -x : x);

  // odds = 2^-size in 1/2^24, between two entries of the table
  const std::uint32_t index = size >> 8 & 0xFF;
  const std::uint32_t between = (kPower[index] - kPower[index + 1]) * (size & 0xFF) >> 8;
  const std::uint32_t odds = (kPower[index] - between) << 8 >> (size >> 16);

  const auto larger = static_cast<std::uint32_t>((std::uint64_t{1} << 40) / ((1u << 24) + odds));
  const std::uint32_t probability = x < 0 ? kProbabilityOne - larger : larger;
  return std::clamp(probability, kMinProbability, kProbabilityOne - kMinProbability);
}

}  // namespace fbs
