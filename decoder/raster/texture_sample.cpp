#include "decoder/raster/texture_sample.h"

#include <algorithm>

#include "common/state.h"

namespace fbs {

static_assert(kMaxSampleLight == kMaxLight << 16);

namespace {

/// 2^-8 of 1/16 grey level
std::int32_t limited(std::int64_t light) {
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(light, -kMaxSampleLight, kMaxSampleLight) >> 8);
}

}  // namespace

std::uint8_t texture_sample(const ConstPlaneView& texture, std::int64_t u, std::int64_t v) {
  u = std::clamp<std::int64_t>(u, 0, std::int64_t{texture.width - 1} << 16);
  v = std::clamp<std::int64_t>(v, 0, std::int64_t{texture.height - 1} << 16);
  const int x0 = static_cast<int>(u >> 16), y0 = static_cast<int>(v >> 16);
  const int x1 = std::min(x0 + 1, texture.width - 1), y1 = std::min(y0 + 1, texture.height - 1);
  const std::uint8_t *const top = texture.row(y0), *const bottom = texture.row(y1);
  const int fx = static_cast<int>((u >> 8) & 255), fy = static_cast<int>((v >> 8) & 255);
  const int above = top[x0] * (256 - fx) + top[x1] * fx, below = bottom[x0] * (256 - fx) + bottom[x1] * fx;
  return static_cast<std::uint8_t>((above * (256 - fy) + below * fy + (1 << 15)) >> 16);
}

std::uint8_t lit(int luma, std::int64_t offset, std::int64_t gain) {
  const std::int32_t by_gain = (luma - 128) * limited(gain) >> 6;
  const std::int32_t sum = (luma << 12) + limited(offset) + by_gain;  // 2^-12 grey level
  return static_cast<std::uint8_t>(std::clamp((sum + (1 << 11)) >> 12, 0, 255));
}

std::uint8_t unlit(int luma, std::int64_t offset, std::int64_t gain) {
  constexpr std::int32_t kOne = 1 << 18, kLeast = 1 << 16;
  const std::int64_t factor = std::max(kOne + limited(gain), kLeast);
  const std::int64_t sum = (std::int64_t{luma - 128} << 18) - (std::int64_t{limited(offset)} << 6);
  constexpr std::int64_t kAbove = 1 << 11;  // makes the dividend positive
  const std::int64_t before = (sum + factor / 2 + kAbove * factor) / factor - kAbove;
  return static_cast<std::uint8_t>(std::clamp<std::int64_t>(128 + before, 0, 255));
}

}  // namespace fbs
