#include "decoder/raster/texture_sampler.h"

#include <algorithm>

namespace fbs {
namespace {

std::uint8_t sample(const ConstPlaneView& p, std::int64_t u, std::int64_t v) {
  u = std::clamp<std::int64_t>(u, 0, std::int64_t{p.width - 1} << 16);
  v = std::clamp<std::int64_t>(v, 0, std::int64_t{p.height - 1} << 16);
  const int x0 = static_cast<int>(u >> 16), y0 = static_cast<int>(v >> 16);
  const int x1 = std::min(x0 + 1, p.width - 1), y1 = std::min(y0 + 1, p.height - 1);
  const std::uint8_t *const top = p.row(y0), *const bottom = p.row(y1);
  const int fx = static_cast<int>((u >> 8) & 255), fy = static_cast<int>((v >> 8) & 255);
  const int above = top[x0] * (256 - fx) + top[x1] * fx, below = bottom[x0] * (256 - fx) + bottom[x1] * fx;
  return static_cast<std::uint8_t>((above * (256 - fy) + below * fy + (1 << 15)) >> 16);
}

}  // namespace

void sample_row(const ConstPlaneView& texture, const TextureRow& at, std::uint8_t* out, int count) {
  for (int i = 0; i < count; ++i) out[i] = sample(texture, at.u.at(i), at.v.at(i));
}

}  // namespace fbs
