// How samples of more than 8 bits become 8, so that smooth slopes have no bands.
#pragma once

#include <array>
#include <cstdint>

namespace fbs {

/// Bayer's ordered dither: 64 thresholds, 1/128 to 127/128 of a level, in units of 1/128. The same at each
/// picture, so that what stands still costs no bits. Added before the division, it keeps means over 8 x 8
/// samples; what eight bits could hold stays exact. Source: B. E. Bayer, An Optimum Method for Two-Level
/// Rendition of Continuous-Tone Pictures, 1973.
inline constexpr auto kDither = [] {
  std::array<std::array<std::uint8_t, 8>, 8> thresholds{};
  for (unsigned y = 0; y < 8; ++y) {
    for (unsigned x = 0; x < 8; ++x) {
      unsigned rank = 0;  // the bits of x ^ y and y in turn, the lowest first
      for (unsigned bit = 0; bit < 3; ++bit) rank = rank << 2 | ((x ^ y) >> bit & 1) << 1 | (y >> bit & 1);
      thresholds[y][x] = static_cast<std::uint8_t>(2 * rank + 1);
    }
  }
  return thresholds;
}();

/// @return the threshold at a sample's place, for levels of `unit`; below `unit`
template <class Integer>
constexpr Integer dither(int x, int y, Integer unit) {
  return kDither[static_cast<unsigned>(y) % 8][static_cast<unsigned>(x) % 8] * unit / 128;
}

}  // namespace fbs
