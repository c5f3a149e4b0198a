#include "decoder/pattern/upscale.h"

#include <algorithm>
#include <cassert>
#include <vector>

namespace fbs {
namespace {

constexpr int kReach = 3;  // the most samples that a filter reads beyond the nearest one

// Sums in one direction are taken around zero, where they fit 16 bits.
constexpr int kMiddleGrey = 128;

/// One vertical filter sum of reduced samples per column, for one full row.
/// @param to  reduced.width sums, with room for kReach before and after, which are filled from the border
void filter_columns(const Plane& reduced, int y, std::int16_t* to) {
  const int nearest = y / 2, step = y % 2 == 0 ? -1 : 1;
  std::array<const std::uint8_t*, kUpscaleTaps.size()> rows;
  for (int k = 0; k < std::ssize(rows); ++k)
    rows[k] = reduced.row(std::clamp(nearest + step * (k - kUpscaleNearestTap), 0, reduced.height - 1));
  for (int x = 0; x < reduced.width; ++x) {
    int sum = -(kMiddleGrey << kUpscaleTapsLog2);
    for (std::size_t k = 0; k < rows.size(); ++k) sum += kUpscaleTaps[k] * rows[k][x];
    to[x] = static_cast<std::int16_t>(sum);
  }
  std::fill_n(to - kReach, kReach, to[0]);
  std::fill_n(to + reduced.width, kReach, to[reduced.width - 1]);
}

std::uint8_t sample_of(const std::int16_t* nearest, std::ptrdiff_t step) {
  constexpr int kShift = 2 * kUpscaleTapsLog2;
  int sum = (kMiddleGrey << kShift) + (1 << (kShift - 1));
  for (std::ptrdiff_t k = 0; k < std::ssize(kUpscaleTaps); ++k)
    sum += kUpscaleTaps[k] * nearest[step * (k - kUpscaleNearestTap)];
  return static_cast<std::uint8_t>(std::clamp(sum >> kShift, 0, 255));
}

}  // namespace

Plane upscaled(const Plane& reduced, int width, int height) {
  assert(reduced.width == (width + 1) / 2 && reduced.height == (height + 1) / 2);
  Plane out(width, height);
  std::vector<std::int16_t> sums(static_cast<std::size_t>(reduced.width) + 2 * kReach);
  const std::int16_t* const nearest = sums.data() + kReach;
  for (int y = 0; y < height; ++y) {
    filter_columns(reduced, y, sums.data() + kReach);
    std::uint8_t* to = out.row(y);
    for (int i = 0; i < width / 2; ++i) {
      to[2 * i] = sample_of(nearest + i, -1);
      to[2 * i + 1] = sample_of(nearest + i, 1);
    }
    if (width % 2 == 1) to[width - 1] = sample_of(nearest + width / 2, -1);
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
