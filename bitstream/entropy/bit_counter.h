// Counts the bits that a RangeEncoder would write: same interface, same adaptation of contexts.
#pragma once

#include <cstdint>

#include "bitstream/entropy/adaptive_bit.h"
#include "bitstream/entropy/logistic.h"

namespace fbs {

class BitCounter {
 public:
  static constexpr bool kReads = false;

  bool raw_bit(std::uint32_t zero, bool value) {
    cost_ += cost_of(value ? kProbabilityOne - zero : zero);
    return value;
  }
  bool bit(AdaptiveBit& context, bool value) {
    raw_bit(context.zero(), value);
    context.update(value);
    return value;
  }
  std::uint32_t bypass(int count, std::uint32_t value) {
    cost_ += static_cast<std::uint64_t>(count) << 16;
    return value;
  }

  /// Sum of all costs so far in 1/256 bit, rounded.
  [[nodiscard]] std::uint64_t bits_x256() const { return (cost_ + 128) >> 8; }

 private:
  std::uint64_t cost_ = 0;  // 1/65536 bit
};

}  // namespace fbs
