// One sample of a texture, and its light: SPEC 10.8 and 10.11. Integers only.
#pragma once

#include <cstdint>

#include "common/picture.h"

namespace fbs {

/// Bilinear, to 1/256 sample. Positions outside the texture repeat its border.
/// @param u, v  2^-16 sample; integers lie on the centres of samples
[[nodiscard]] std::uint8_t texture_sample(const ConstPlaneView& texture, std::int64_t u, std::int64_t v);

/// Light at a sample, 2^-16 of 1/16 grey level, is clamped to +- this.
inline constexpr std::int32_t kMaxSampleLight = 1 << 28;

/// Luma under a light.
/// @param offset, gain  as VertexLight, Q16
[[nodiscard]] std::uint8_t lit(int luma, std::int64_t offset, std::int64_t gain);

/// The inverse: luma before this light fell on it.
[[nodiscard]] std::uint8_t unlit(int luma, std::int64_t offset, std::int64_t gain);

}  // namespace fbs
