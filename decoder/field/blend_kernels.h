// Blends blocks from the samples of their sources. SPEC 11.6. Vector code for every kind of processor that
// Highway knows, chosen at run time; blend_kernels_plain.h defines the results. Integers only.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

#include "common/picture.h"
#include "decoder/field/node_grid.h"

namespace fbs {

inline constexpr int kChromaBlockSize = kBlockSize / 2;

/// Samples of a block in a row of plane 0 (luma), 1 or 2.
[[nodiscard]] constexpr int block_size(std::size_t plane) {
  return plane == 0 ? kBlockSize : kChromaBlockSize;
}

/// The part of a square of samples that lies in a plane.
template <class View>
[[nodiscard]] glm::ivec2 size_inside(glm::ivec2 first, int size, const View& plane) {
  return {std::clamp(plane.width - first.x, 0, size), std::clamp(plane.height - first.y, 0, size)};
}

/// Samples in memory of any owner.
struct SampleBlock {
  const std::uint8_t* samples;
  std::ptrdiff_t stride;
};

/// The samples of a source in a block.
struct BlendedSource {
  std::array<SampleBlock, 3> planes;  ///< Y, U, V; U and V have one stride
  /// At the block's upper left node. The weights of all sources sum to kNodeWeightOne at each node.
  const std::uint16_t* weight;
};

/// Distance from the weight at a node to those at the next.
struct NodeSteps {
  std::ptrdiff_t column, line;
};

/// Blends 16 x 16 luma samples.
void blend_luma_block(std::span<const BlendedSource> sources, NodeSteps steps, std::uint8_t* out,
                      std::ptrdiff_t stride);

/// Blends 8 x 8 samples of both chroma planes.
void blend_chroma_block(std::span<const BlendedSource> sources, NodeSteps steps,
                        const std::array<std::uint8_t*, 2>& out, std::ptrdiff_t stride);

/// Copies some samples of a block.
void copy_samples(SampleBlock from, glm::ivec2 size, std::uint8_t* out, std::ptrdiff_t stride);

/// Blends the part of a block that lies in a picture.
/// @param sources  at least one
/// @param block    its column and row
/// @param target   Y, U, V; planes without samples are left out
void draw_blend(std::span<const BlendedSource> sources, NodeSteps steps, glm::ivec2 block,
                const std::array<PlaneView, 3>& target);

}  // namespace fbs
