#include "encoder/patterns/downscale.h"

#include <algorithm>
#include <array>

#include "decoder/pattern/upscale.h"

namespace fbs {
namespace {

/// Weights of the full samples from 2 i - kBefore on for reduced sample i.
constexpr std::array<int, 12> transposed_taps() {
  constexpr int kTaps = static_cast<int>(kUpscaleTaps.size());
  std::array<int, 2 * kTaps> out{};
  for (int k = 0; k < kTaps; ++k) {
    out[2 * (kTaps - 1 - k)] = kUpscaleTaps[k];
    out[2 * k + 1] = kUpscaleTaps[k];
  }
  return out;
}
constexpr std::array<int, 12> kTaps = transposed_taps();
constexpr int kBefore = 5;
constexpr int kTapsLog2 = kUpscaleTapsLog2 + 1;

}  // namespace

Plane downscaled(const Plane& full) {
  Plane out((full.width + 1) / 2, (full.height + 1) / 2);
  std::vector<int> sums(static_cast<std::size_t>(full.width));
  for (int y = 0; y < out.height; ++y) {
    std::ranges::fill(sums, 0);
    for (int k = 0; k < std::ssize(kTaps); ++k) {
      const std::uint8_t* row = full.row(std::clamp(2 * y + k - kBefore, 0, full.height - 1));
      for (int x = 0; x < full.width; ++x) sums[x] += kTaps[k] * row[x];
    }
    for (int x = 0; x < out.width; ++x) {
      int sum = 1 << (2 * kTapsLog2 - 1);
      for (int k = 0; k < std::ssize(kTaps); ++k)
        sum += kTaps[k] * sums[std::clamp(2 * x + k - kBefore, 0, full.width - 1)];
      out.row(y)[x] = static_cast<std::uint8_t>(std::clamp(sum >> (2 * kTapsLog2), 0, 255));
    }
  }
  return out;
}

Picture downscaled(const Picture& full) {
  Picture out;
  out.y = downscaled(full.y);
  out.u = downscaled(full.u);
  out.v = downscaled(full.v);
  return out;
}

}  // namespace fbs
