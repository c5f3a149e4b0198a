// What happens to the samples of a run, on plain pointers and in fixed point: sampling, light, mouth
// interior. SPEC 10.8, 10.10, 10.11. Integers only.
//
// A kernel that skips a check is named after what its caller has made sure of; beside it stands the plain one
// that it must agree with bit for bit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/picture.h"
#include "common/state.h"

namespace fbs {

/// A value that changes linearly along a run.
struct LinearRow {
  std::int64_t first;  ///< at the first sample
  std::int64_t step;   ///< per sample
  [[nodiscard]] std::int64_t at(std::int64_t sample) const { return first + sample * step; }
};

/// Texture position along a run, 2^-16 sample of the texture; integers lie on the centres of samples.
struct TextureRow {
  LinearRow u, v;
};

/// Of four neighbours.
/// @param fx, fy  share of the right and of the lower samples, 1/256
[[nodiscard]] inline std::uint8_t bilinear(std::int32_t top_left, std::int32_t top_right,
                                           std::int32_t bottom_left, std::int32_t bottom_right,
                                           std::int32_t fx, std::int32_t fy) {
  const std::int32_t top = top_left * (256 - fx) + top_right * fx;
  const std::int32_t bottom = bottom_left * (256 - fx) + bottom_right * fx;
  return static_cast<std::uint8_t>((top * (256 - fy) + bottom * fy + (1 << 15)) >> 16);
}

/// Bilinear, to 1/256 sample. Positions outside the texture repeat its border.
void sample_row_clamped(const ConstPlaneView& texture, const TextureRow& at, std::uint8_t* out, int count);

/// The same for a run whose positions, and those of all samples that they mix, lie inside the texture.
/// Inline: most runs are a few samples long.
inline void sample_row_inside(const ConstPlaneView& texture, const TextureRow& at, std::uint8_t* out,
                              int count) {
  auto u = static_cast<std::int32_t>(at.u.first), v = static_cast<std::int32_t>(at.v.first);
  const auto du = static_cast<std::int32_t>(at.u.step), dv = static_cast<std::int32_t>(at.v.step);
  const std::uint8_t* const data = texture.data;
  const std::ptrdiff_t stride = texture.stride;
  for (int i = 0; i < count; ++i, u += du, v += dv) {
    const std::uint8_t* s = data + (v >> 16) * stride + (u >> 16);
    out[i] = bilinear(s[0], s[1], s[stride], s[stride + 1], (u >> 8) & 255, (v >> 8) & 255);
  }
}

inline constexpr int kWeightOneLog2 = 12;
inline constexpr int kWeightOne = 1 << kWeightOneLog2;  ///< weights in a blend sum to this

inline constexpr int kLightOneLog2 = 16;  ///< light along a run counts 2^-16 of 1/16 grey level

/// Adds light to luma in place. Offset and gain are clamped to +-kMaxLight: slivers, whose gradients are
/// clamped, go beyond what their corners have.
/// @param offset, gain  as VertexLight, Q16
void light_row_clamped(std::uint8_t* luma, const LinearRow& offset, const LinearRow& gain, int count);

/// The same for a run along which neither leaves +-kMaxLight.
void light_row_inside(std::uint8_t* luma, const LinearRow& offset, const LinearRow& gain, int count);

/// Chooses between the two.
void light_row(std::uint8_t* luma, const LinearRow& offset, const LinearRow& gain, int count);

/// Mixes colours over samples in place.
/// @param colours  where the ramp is 0, 128 and 256
/// @param opacity  0..256
/// @param ramp     place between upper and lower lip, 0..256 in Q16; clamped
void mix_interior_row(std::uint8_t* samples, const std::array<std::uint8_t, kInteriorCount>& colours,
                      std::int32_t opacity, const LinearRow& ramp, int count);

/// Weights of one source of a blend along a run.
/// @param weight  2^-12 in Q16
/// @param left    what sources before it have left, 2^-12; takes what this one leaves
/// @param out     weight, clamped to 0..left
void weight_row(const LinearRow& weight, std::int16_t* left, std::int16_t* out, int count);

/// sum += samples * weights
void add_weighted_row(const std::uint8_t* samples, const std::int16_t* weights, std::int32_t* sum, int count);

/// sum += samples * weight
void add_scaled_row(const std::uint8_t* samples, std::int32_t weight, std::int32_t* sum, int count);

/// Sums of weighted samples, rounding added before, to samples.
void round_row(const std::int32_t* sum, std::uint8_t* out, int count);

}  // namespace fbs
