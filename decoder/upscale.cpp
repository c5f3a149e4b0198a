#include "decoder/upscale.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace fbs {
namespace {

// Catmull-Rom at a quarter of a sample: gains of the reduced samples from the one before the nearest
// outwards. An odd sample reads them left to right, an even one is its mirror image.
constexpr std::array<int, 4> kTaps{-9, 111, 29, -3};
constexpr int kTapsLog2 = 7;  // they add up to 128

constexpr int kBefore = 1;  // taps before the nearest sample
constexpr int kReach = 2;   // samples that a filter reaches beyond the nearest one, on either side

/// Filters the samples around `at` (its nearest reduced sample) for the even and the odd sample there.
template <class T>
int even_sample(const T* at, std::ptrdiff_t step) {
  int sum = 0;
  for (std::ptrdiff_t k = 0; k < std::ssize(kTaps); ++k) sum += kTaps[k] * at[(kBefore - k) * step];
  return sum;
}
template <class T>
int odd_sample(const T* at, std::ptrdiff_t step) {
  return even_sample(at, -step);
}

}  // namespace

Plane upscaled(const Plane& reduced, int width, int height) {
  assert(reduced.width == (width + 1) / 2 && reduced.height == (height + 1) / 2);
  Plane out(width, height);
  // Sums of each reduced row, at full width and scaled by 2^kTapsLog2.
  const std::ptrdiff_t stride = width + (width & 1);
  std::vector<std::int32_t> wide(static_cast<std::size_t>(stride) * (reduced.height + 2 * kReach));
  std::vector<std::uint8_t> padded(static_cast<std::size_t>(reduced.width) + 2 * kReach);
  for (int y = -kReach; y < reduced.height + kReach; ++y) {
    const std::uint8_t* row = reduced.row(std::clamp(y, 0, reduced.height - 1));
    std::fill_n(padded.begin(), kReach, row[0]);
    std::copy_n(row, reduced.width, padded.begin() + kReach);
    std::fill_n(padded.end() - kReach, kReach, row[reduced.width - 1]);
    std::int32_t* to = wide.data() + (y + kReach) * stride;
    for (int x = 0; x < reduced.width; ++x) {
      to[2 * x] = even_sample(&padded[x + kReach], 1);
      to[2 * x + 1] = odd_sample(&padded[x + kReach], 1);
    }
  }
  constexpr int kRound = 1 << (2 * kTapsLog2 - 1);
  for (int y = 0; y < height; ++y) {
    const std::int32_t* from = wide.data() + (y / 2 + kReach) * stride;
    const std::ptrdiff_t down = y % 2 == 0 ? stride : -stride;
    std::uint8_t* to = out.row(y);
    for (int x = 0; x < width; ++x)
      to[x] = static_cast<std::uint8_t>(
          std::clamp((even_sample(from + x, down) + kRound) >> (2 * kTapsLog2), 0, 255));
  }
  return out;
}

Picture upscaled(const Picture& reduced, int width, int height) {
  Picture out;
  out.y = upscaled(reduced.y, width, height);
  out.u = upscaled(reduced.u, (width + 1) / 2, (height + 1) / 2);
  out.v = upscaled(reduced.v, (width + 1) / 2, (height + 1) / 2);
  return out;
}

}  // namespace fbs
