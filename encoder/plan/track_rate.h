// Estimated bits of knots: a model cheap enough for thousands of queries per group.
#pragma once

#include <array>
#include <cstdint>

#include "bitstream/syntax.h"

namespace fbs {

/// Estimates the adaptive TrackCoder's bits from the frequencies of what it has coded before.
class TrackRate {
 public:
  TrackRate();

  /// Bits of one number's change over a span in which its part moves.
  /// @param parameter  0..kParameterCount-1
  [[nodiscard]] double change(std::size_t parameter, std::int32_t change) const {
    if (change == 0) return zero_[parameter];
    const int m = change < 0 ? -change : change;
    return not_zero_[parameter] +
           more_[parameter] * (m < kLinear ? m - 1 : kLinear - 1 + log2_of(m / kLinear));
  }

  /// Bits of a span without its changes: its length, and whether the part moves.
  [[nodiscard]] double span(std::size_t part, bool moves, bool to_end) const {
    return (moves ? moves_[part] : holds_[part]) + (to_end ? to_end_[part] : not_to_end_[part]);
  }

  /// Bits of a whole span.
  [[nodiscard]] double knot(std::size_t part, const Knot& from, const Knot& to, std::int32_t pictures) const;

  /// Learns from a group that has been coded.
  void learn(const MotionGroup& group);

 private:
  static constexpr int kLinear = 12;
  static double log2_of(int value);
  void update();

  // Counts, weighing older groups less.
  std::array<double, kParameterCount> seen_{}, changed_{}, size_{};
  std::array<double, kPartCount> spans_{}, moved_{}, ended_{};
  // Bits derived from the counts.
  std::array<double, kParameterCount> zero_{}, not_zero_{}, more_{};
  std::array<double, kPartCount> moves_{}, holds_{}, to_end_{}, not_to_end_{};
};

}  // namespace fbs
