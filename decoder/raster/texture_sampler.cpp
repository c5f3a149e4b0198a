#include "decoder/raster/texture_sampler.h"

#include <algorithm>

namespace fbs {
namespace {

/// Texture positions are 1/64 luma pixel in all planes, gradients 2^-16 sample.
constexpr std::int64_t kHalfSample = 1 << 15;

/// Of four neighbours.
/// @param fx, fy  share of the right and of the lower samples, 1/256
std::uint8_t bilinear(std::int32_t top_left, std::int32_t top_right, std::int32_t bottom_left,
                      std::int32_t bottom_right, std::int32_t fx, std::int32_t fy) {
  const std::int32_t top = top_left * (256 - fx) + top_right * fx;
  const std::int32_t bottom = bottom_left * (256 - fx) + bottom_right * fx;
  return static_cast<std::uint8_t>((top * (256 - fy) + bottom * fy + (1 << 15)) >> 16);
}

std::uint8_t sample_clamped(const ConstPlaneView& p, std::int64_t u, std::int64_t v) {
  u = std::clamp<std::int64_t>(u, 0, std::int64_t{p.width - 1} << 16);
  v = std::clamp<std::int64_t>(v, 0, std::int64_t{p.height - 1} << 16);
  const int x0 = static_cast<int>(u >> 16), y0 = static_cast<int>(v >> 16);
  const int x1 = std::min(x0 + 1, p.width - 1), y1 = std::min(y0 + 1, p.height - 1);
  const std::uint8_t* top = p.row(y0);
  const std::uint8_t* bottom = p.row(y1);
  return bilinear(top[x0], top[x1], bottom[x0], bottom[x1], static_cast<std::int32_t>((u >> 8) & 255),
                  static_cast<std::int32_t>((v >> 8) & 255));
}

/// Whether all positions of a run, and the samples right of or below them, lie inside the texture.
bool is_inside(const LinearRow& row, int count, int size) {
  const std::int64_t last = row.at(count - 1), end = std::int64_t{size - 1} << 16;
  return std::min(row.first, last) >= 0 && std::max(row.first, last) < end;
}

void sample_row_inside(const ConstPlaneView& texture, const TextureRow& at, std::uint8_t* out, int count) {
  auto u = static_cast<std::int32_t>(at.u.first), v = static_cast<std::int32_t>(at.v.first);
  const auto du = static_cast<std::int32_t>(at.u.step), dv = static_cast<std::int32_t>(at.v.step);
  const std::ptrdiff_t stride = texture.stride;
  for (int i = 0; i < count; ++i, u += du, v += dv) {
    const std::uint8_t* s = texture.data + (v >> 16) * stride + (u >> 16);
    out[i] = bilinear(s[0], s[1], s[stride], s[stride + 1], (u >> 8) & 255, (v >> 8) & 255);
  }
}

}  // namespace

void sample_row(const ConstPlaneView& texture, const TextureRow& at, std::uint8_t* out, int count) {
  if (is_inside(at.u, count, texture.width) && is_inside(at.v, count, texture.height)) {
    sample_row_inside(texture, at, out, count);
  } else {
    for (int i = 0; i < count; ++i) out[i] = sample_clamped(texture, at.u.at(i), at.v.at(i));
  }
}

TextureSampler::TextureSampler(const TriangleSetup& setup, std::span<const ConstPlaneView> textures,
                               const std::array<glm::ivec2, 3>& c)
    : textures_(textures),
      u_(setup.gradient({c[0].x, c[1].x, c[2].x}, setup.position_bits())),
      v_(setup.gradient({c[0].y, c[1].y, c[2].y}, setup.position_bits())),
      position_bits_(setup.position_bits()),
      u_lanes_(multiples(u_.dx)),
      v_lanes_(multiples(v_.dx)) {
  u_.origin -= kHalfSample;
  v_.origin -= kHalfSample;
}

BlockSamples TextureSampler::sample_plain(const TextureRow& at, int count) const {
  BlockSamples out;
  for (std::size_t i = 0; i < textures_.size(); ++i) {
    std::array<std::uint8_t, kLaneCount> samples{};
    sample_row(textures_[i], at, samples.data(), count);
    out[i] = load_lanes(samples.data());
  }
  return out;
}

}  // namespace fbs
