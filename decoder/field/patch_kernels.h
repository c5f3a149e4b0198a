// The inner loops of the surround: displaced patches, and blocks blended from them. SPEC 10.3 and 11.6.
// Each has vector code for every kind of processor that Highway knows, chosen at run time, and a plain
// counterpart in patch_kernels_plain.h that defines its results. Integers only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

#include "decoder/field/node_grid.h"

namespace fbs {

/// Samples in anybody's memory.
struct SampleBlock {
  const std::uint8_t* samples;
  std::ptrdiff_t stride;
};

/// What a source shows in a block, and its weights at the block's nine nodes, row by row, which with those of
/// the other sources sum to 256 at each.
struct BlendedSource {
  SampleBlock block;
  std::array<std::uint16_t, 9> weight;
};

inline constexpr int kChromaBlockSize = kBlockSize / 2;

/// Blends 16 x 16 luma samples.
void blend_luma_block(std::span<const BlendedSource> sources, std::uint8_t* out, std::ptrdiff_t stride);

/// Blends 8 x 8 samples of one chroma plane.
void blend_chroma_block(std::span<const BlendedSource> sources, std::uint8_t* out, std::ptrdiff_t stride);

/// Copies some samples of a block.
void copy_samples(SampleBlock from, glm::ivec2 size, std::uint8_t* out, std::ptrdiff_t stride);

/// Blends a block, or what of it is wanted.
/// @param plane    0 luma, 1 and 2 chroma
/// @param sources  at least one
/// @param size     samples, up to those of a block
void draw_blend(std::size_t plane, std::span<const BlendedSource> sources, glm::ivec2 size, std::uint8_t* out,
                std::ptrdiff_t stride);

inline constexpr int kFractionOneLog2 = 6;  ///< of places between samples

/// Memory for what one source shows in a block of a plane. Wider than the block: patches are written whole
/// vectors at a time, from left to right.
struct WarpedBlock {
  static constexpr std::ptrdiff_t kStride = 32;
  alignas(32) std::array<std::uint8_t, kStride * kBlockSize> samples;
};

/// Samples between those of a texture, all by the same fraction.
/// @param from     the upper left sample; one more column and row than the area are read, and columns up to
///                 the next multiple of 8, and one
/// @param fraction 0..63 in x and y
/// @param size     samples; of columns, up to the next multiple of 8 are written
void warp_even(const std::uint8_t* from, std::ptrdiff_t stride, glm::ivec2 fraction, glm::ivec2 size,
               std::uint8_t* out);

/// Displacement at the upper left, upper right, lower left and lower right node of a patch, 1/64 luma sample.
using PatchNodes = std::array<glm::ivec2, 4>;

/// The 8 x 8 luma samples of a patch, displaced linearly between its nodes.
/// @param from  the patch's upper left sample in the texture
void warp_bent_luma(const std::uint8_t* from, std::ptrdiff_t stride, const PatchNodes& nodes,
                    std::uint8_t* out);

/// The 4 x 4 samples of it in both chroma planes.
void warp_bent_chroma(const std::array<const std::uint8_t*, 2>& from, std::ptrdiff_t stride,
                      const PatchNodes& nodes, const std::array<std::uint8_t*, 2>& out);

}  // namespace fbs
