// Time of a picture: an integer count of 1/90000 s, the clock in which common video rates are exact.
#pragma once

#include <cstdint>

#include "common/picture.h"

namespace fbs {

inline constexpr std::int64_t kTicksPerSecond = 90000;

/// Time of picture `index` of a video without timestamps, rounded to the nearest tick.
/// @param rate  pictures per second, both parts above zero
[[nodiscard]] constexpr std::int64_t regular_pts(std::int64_t index, Rational rate) {
  const std::int64_t num = rate.num;
  const std::int64_t whole = index / num * kTicksPerSecond * rate.den;
  return whole + (index % num * kTicksPerSecond * rate.den + num / 2) / num;
}

}  // namespace fbs
