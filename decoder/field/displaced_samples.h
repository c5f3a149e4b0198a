// Samples of a displaced texture in a square of the picture. SPEC 10.3. Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

#include "decoder/field/blend_kernels.h"
#include "decoder/field/padded_plane.h"
#include "decoder/field/warp_kernels.h"

namespace fbs {

/// Y, U, V.
using BlockSamples3 = std::array<SampleBlock, 3>;
using BlockMemory = std::array<WarpedBlock, 3>;

/// Blocks read a few samples of many rows, which hardware prefetchers miss. Asks for what the next blocks of
/// the row read of a plane.
/// @param from  the block's samples
inline void prefetch_next_blocks(SampleBlock from, int size) {
  constexpr int kCacheLine = 64;
  for (int y = 0; y < size; ++y) __builtin_prefetch(from.samples + y * from.stride + kCacheLine);
}
/// Whether the block is the first of those that one such request is for.
[[nodiscard]] constexpr bool begins_cache_line(int column, std::size_t plane) {
  return column % (plane == 0 ? 4 : 8) == 0;
}

/// The samples of a block that is displaced as a whole.
/// @param block   its column and row
/// @param by      1/64 luma sample
/// @param memory  for planes sampled between the samples of the texture
[[nodiscard]] BlockSamples3 displaced_block(const PaddedPicture& texture, glm::ivec2 block, glm::ivec2 by,
                                            bool has_chroma, BlockMemory& memory);

/// Draws a patch that is displaced as a whole.
/// @param patch  its column and row
/// @param out    position of the patch's upper left sample in each plane
void draw_even_patch(const PaddedPicture& texture, glm::ivec2 patch, glm::ivec2 by, bool has_chroma,
                     const std::array<std::uint8_t*, 3>& out);

/// Draws a patch that is displaced linearly between its nodes.
void draw_bent_patch(const PaddedPicture& texture, glm::ivec2 patch, const PatchNodes& nodes, bool has_chroma,
                     const std::array<std::uint8_t*, 3>& out);

}  // namespace fbs
