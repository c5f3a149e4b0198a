// What happens to the samples of a run between pattern and picture: light and mouth interior. SPEC 10.10, 10.11.
// Integers only.
//
// A kernel that skips a check is named after what its caller has made sure of; beside it stands the plain one
// that it must agree with bit for bit.
#pragma once

#include <array>
#include <cstdint>

#include "common/state.h"
#include "decoder/raster/linear_row.h"

namespace fbs {

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

}  // namespace fbs
