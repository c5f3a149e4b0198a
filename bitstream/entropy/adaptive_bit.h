// A binary context: the estimated probability of a zero, learned from the bits coded with it. SPEC 2.3.
#pragma once

#include <algorithm>
#include <cstdint>

namespace fbs {

inline constexpr std::uint32_t kProbabilityOne = 1u << 16;
inline constexpr std::uint32_t kMinProbability = 32;  ///< of either value, in 1/65536: a cost of 0.0007 bit

/// Mean of a fast and a slow estimate. Both begin at one half as running means, so that a context adapts from
/// its first bit on, and become exponential windows of 24 and 128 bits.
/// Differs from CABAC and LZMA, which have one fixed rate: our contexts see tens of bits, not millions.
class AdaptiveBit {
 public:
  AdaptiveBit() = default;
  /// As if it had coded bits already.
  /// @param zero  probability of a zero, 1/65536; not 0  @param count  bits, 0..128
  AdaptiveBit(std::uint16_t zero, std::uint8_t count) : fast_(zero), slow_(zero), count_(count) {}

  /// Probability of a zero in 1/65536; kMinProbability .. kProbabilityOne - kMinProbability.
  [[nodiscard]] std::uint32_t zero() const {
    const std::uint32_t mean = (std::uint32_t{fast_} + slow_ + 1) >> 1;
    return std::clamp(mean, kMinProbability, kProbabilityOne - kMinProbability);
  }

  void update(bool value) {
    fast_ = moved(fast_, value, std::min<std::int32_t>(2 * count_ + 3, 2 * kFastWindow));
    slow_ = moved(slow_, value, std::min<std::int32_t>(2 * count_ + 3, 2 * kSlowWindow));
    if (count_ < kSlowWindow) ++count_;
  }

  [[nodiscard]] int count() const { return count_; }  ///< bits seen, up to 128

  /// Level of experience for Mixer: 0..5 for 0, 1, 2, 3..5, 6..15, 16 and more bits coded.
  [[nodiscard]] int experience() const {
    if (count_ < 3) return count_;
    return count_ < 6 ? 3 : count_ < 16 ? 4 : 5;
  }

 private:
  static constexpr int kFastWindow = 24;
  static constexpr int kSlowWindow = 128;

  // One step towards the value just coded; `divisor` is twice the window. The quotient is truncated.
  static std::uint16_t moved(std::uint16_t from, bool value, std::int32_t divisor) {
    const std::int32_t target = value ? 0 : static_cast<std::int32_t>(kProbabilityOne) - 1;
    return static_cast<std::uint16_t>(from + 2 * (target - from) / divisor);
  }

  std::uint16_t fast_ = kProbabilityOne / 2;  // probability of a zero, 1/65536
  std::uint16_t slow_ = kProbabilityOne / 2;
  std::uint8_t count_ = 0;  // bits seen, up to kSlowWindow
};

}  // namespace fbs
