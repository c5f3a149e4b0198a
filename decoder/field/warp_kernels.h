// Displaced samples of the surround. SPEC 10.3. Vector code as in blend_kernels.h; warp_kernels_plain.h
// defines the results. Integers only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>

#include "decoder/field/node_grid.h"
#include "decoder/field/warped_block.h"

namespace fbs {

inline constexpr int kFractionOneLog2 = 6;  ///< for positions between samples

/// The same position in U and V, which have one stride.
using ChromaSamples = std::array<const std::uint8_t*, 2>;
using ChromaOut = std::array<std::uint8_t*, 2>;

/// Luma samples interpolated in a texture, all by the same fraction. Rows of the output are
/// WarpedBlock's.
/// @param from      the upper left sample; one more column and row than the area are read
/// @param fraction  0..63 in x and y
/// @param size      of the square of samples: a block's or a patch's
void warp_even_luma(const std::uint8_t* from, std::ptrdiff_t stride, glm::ivec2 fraction, int size,
                    std::uint8_t* out);

/// The same in both chroma planes.
/// @param from  nine columns are read, whatever the size
/// @param out   eight columns are written, whatever the size
void warp_even_chroma(const ChromaSamples& from, std::ptrdiff_t stride, glm::ivec2 fraction, int size,
                      const ChromaOut& out);

/// Displacement at the upper left, upper right, lower left and lower right node of a patch, 1/64 luma sample.
using PatchNodes = std::array<glm::ivec2, 4>;

/// The 8 x 8 luma samples of a patch, displaced linearly between its nodes.
/// @param from  the patch's upper left sample in the texture; sixteen columns are read from each place on
void warp_bent_luma(const std::uint8_t* from, std::ptrdiff_t stride, const PatchNodes& nodes,
                    std::uint8_t* out);

/// The 4 x 4 samples of the patch in both chroma planes.
/// @param from  eight columns are read from each place on
void warp_bent_chroma(const ChromaSamples& from, std::ptrdiff_t stride, const PatchNodes& nodes,
                      const ChromaOut& out);

}  // namespace fbs
