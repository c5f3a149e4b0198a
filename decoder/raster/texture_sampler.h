// Samples of a texture: SPEC 10.8. Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

#include "common/picture.h"
#include "decoder/raster/linear_row.h"
#include "decoder/raster/row_block.h"

namespace fbs {

inline constexpr std::size_t kMaxPlanes = 2;  ///< of one scale

/// A block in each plane.
using BlockSamples = std::array<Lanes, kMaxPlanes>;

/// Texture position along a run, 2^-16 sample of the texture; integers lie on the centres of samples.
struct TextureRow {
  LinearRow u, v;
};

/// Bilinear, to 1/256 sample, one sample after the other. Positions outside the texture repeat its border.
void sample_row(const ConstPlaneView& texture, const TextureRow& at, std::uint8_t* out, int count);

/// Takes a triangle's samples from a texture.
class TextureSampler {
 public:
  /// @param textures  planes of one size
  /// @param corners   of the triangle in them, 1/64 luma pixel
  TextureSampler(const TriangleSetup& setup, std::span<const ConstPlaneView> textures,
                 const std::array<glm::ivec2, 3>& corners);

  /// The same as sample_row().
  [[nodiscard]] BlockSamples sample(const RowBlock& block) const {
    const TextureRow at{{u_.at(block.at, position_bits_), u_.dx}, {v_.at(block.at, position_bits_), v_.dx}};
    return is_straight(at, block.count) ? sample_straight(at) : sample_plain(at, block.count);
  }

 private:
  [[nodiscard]] bool is_straight(const TextureRow& at, int count) const;
  [[nodiscard]] BlockSamples sample_straight(const TextureRow& at) const;
  [[nodiscard]] BlockSamples sample_plain(const TextureRow& at, int count) const;

  std::span<const ConstPlaneView> textures_;
  Gradient u_, v_;
  int position_bits_;
  Lanes u_lanes_, v_lanes_;
};

// Inline: most runs of a triangle are a block or two.

/// Whether the samples come from neighbouring columns of the same two rows, and kLaneCount samples can be read
/// from there.
inline bool TextureSampler::is_straight(const TextureRow& at, int count) const {
  constexpr std::int64_t kOne = 1 << 16;
  const auto below = [](std::int64_t value, std::int64_t end) {
    return static_cast<std::uint64_t>(value) < static_cast<std::uint64_t>(end);
  };
  // The whole parts are those of the first sample plus 1 each in u, plus 0 in v.
  const auto keeps_step = [&](const LinearRow& row, std::int64_t step) {
    return below((row.first & (kOne - 1)) + (count - 1) * (row.step - step), kOne);
  };
  const ConstPlaneView& texture = textures_.front();
  return keeps_step(at.u, kOne) && keeps_step(at.v, 0) && below(at.u.first >> 16, texture.width - kLaneCount) &&
         below(at.v.first >> 16, texture.height - 1);
}

inline BlockSamples TextureSampler::sample_straight(const TextureRow& at) const {
  const Lanes fx = (u_lanes_ + static_cast<std::uint16_t>(at.u.first)) >> 8,
              fy = (v_lanes_ + static_cast<std::uint16_t>(at.v.first)) >> 8;
  const auto mix = [](Lanes a, Lanes b, Lanes share) { return (a << 8) + (b - a) * share; };
  BlockSamples out;
  for (std::size_t i = 0; i < textures_.size(); ++i) {
    const std::ptrdiff_t stride = textures_[i].stride;
    const std::uint8_t* const above = textures_[i].data + (at.v.first >> 16) * stride + (at.u.first >> 16);
    const std::uint8_t* const below = above + stride;
    const Lanes top = mix(load_lanes(above), load_lanes(above + 1), fx);
    const Lanes bottom = mix(load_lanes(below), load_lanes(below + 1), fx);
    // The second step for both bytes of what the first yields: sixteen bits hold it then.
    const Lanes high = mix(top >> 8, bottom >> 8, fy), low = mix(top & 255, bottom & 255, fy);
    out[i] = (high + (low >> 8) + 128) >> 8;
  }
  return out;
}

}  // namespace fbs
