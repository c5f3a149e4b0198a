// Time of a picture: an integer count of 1/90000 s, the clock in which common video rates are exact.
#pragma once

#include <cstdint>

#include "common/picture.h"

namespace fbs {

inline constexpr std::uint32_t kMaxRatePart =
    1000000;  ///< limit of either part of a frame rate: keeps times in 64 bits

/// Whether sources may have this frame rate: 1/100 to 1000 pictures per second.
[[nodiscard]] constexpr bool plausible_rate(Rational rate) {
  if (rate.num == 0 || rate.den == 0 || rate.num > kMaxRatePart || rate.den > kMaxRatePart) return false;
  return rate.num <= 1000 * rate.den && 100 * rate.num >= rate.den;
}

/// Time of picture `index` of a video without timestamps, rounded to the nearest tick.
/// @param rate  pictures per second, a plausible_rate
[[nodiscard]] constexpr std::int64_t regular_pts(std::int64_t index, Rational rate) {
  const std::int64_t num = rate.num;
  const std::int64_t whole = index / num * kTicksPerSecond * rate.den;
  return whole + (index % num * kTicksPerSecond * rate.den + num / 2) / num;
}

}  // namespace fbs
