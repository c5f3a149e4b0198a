// The inner loops over nodes: weights and displacements of all sources, and the motions of blocks. SPEC 10.3
// and 11.5. Vector code as in blend_kernels.h; node_kernels_plain.h defines the results. Integers only.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

#include "decoder/field/node_cover.h"
#include "decoder/field/source_rows.h"

namespace fbs {

/// Weights of the sources at nodes, in 2^-8, from the weights at the points of the mesh, in 2^-12. Sums of
/// the first sources are rounded: each weight is off by less than a step, and all sum to one.
/// @param corners  rows of weights, one for each point
/// @param outside  row for nodes that no triangle covers
/// @param row      size of a row
/// @param step_log2  log2 of a step in 2^-8. Most small weights vanish where it is large
/// @param out      rows of weights, one for each node
void weigh_nodes(std::span<const NodePlace> places, const std::int32_t* corners, const std::uint16_t* outside,
                 std::size_t row, int step_log2, std::uint16_t* out);

/// Positions of a texture that nodes may show, 1/64 luma sample.
struct NodeLimits {
  glm::ivec2 first, last;
};

/// displace_nodes() takes displacements smaller than this.
inline constexpr std::int32_t kMaxShortDisplacement = 1 << 15;

/// Displacements of the sources at nodes from the displacements at the points of the mesh, 1/64 luma sample.
/// A row of x is followed by a row of y.
/// @param moved  rows, one for each point
/// @param out    rows, one for each node
void displace_nodes(const NodeCover& cover, const std::int32_t* moved, const NodeLimits& limits,
                    std::size_t row, std::int32_t* out);

/// The rows of a block's upper left node, and the distance to the next ones.
struct BlockNodes {
  const std::uint16_t* weight;
  const std::int32_t* displacement;  ///< null: no source moves
  std::size_t row;                   ///< size of a row
  std::ptrdiff_t columns;            ///< nodes in a row of the grid

  [[nodiscard]] const std::uint16_t* weight_at(int column, int line) const {
    return weight + (line * columns + column) * static_cast<std::ptrdiff_t>(row);
  }
  [[nodiscard]] const std::int32_t* displacement_at(int column, int line) const {
    return displacement + (line * columns + column) * static_cast<std::ptrdiff_t>(2 * row);
  }
};

/// Invisible differences of displacement within a block or patch, 1/64 luma sample.
inline constexpr std::int32_t kEvenEnough = 16;

/// How a texture is displaced in a patch or block.
enum MotionKind : std::int32_t {
  kStill,  ///< samples stay in place
  kEven,   ///< all samples are displaced alike
  kBent,   ///< displaced linearly between the nodes; a block: patch by patch
};

/// Motions of kRowStep sources in a block.
struct BlockMotions {
  using Row = std::array<std::int32_t, kRowStep>;
  using RowOfBoth = std::array<Row, 2>;  ///< x and y of a displacement

  std::uint32_t shown;             ///< a bit for each source with weight; the rest is valid for these only
  alignas(32) Row whole;           ///< kind of the block
  alignas(32) RowOfBoth whole_by;  ///< if that is kEven
  // For each patch, row by row, if the block is kBent.
  alignas(32) std::array<Row, 4> kind;
  alignas(32) std::array<RowOfBoth, 4> by;  ///< if the patch is kEven
};

/// @param first  the first source, a multiple of kRowStep
void find_motions(const BlockNodes& nodes, std::size_t first, BlockMotions& out);

/// Calls show(first, place, motions) for each source with weight in a block: source first + place, at that
/// place in `motions`.
template <class Show>
void for_each_shown(const BlockNodes& nodes, Show&& show) {
  BlockMotions motions;
  for (std::size_t first = 0; first < nodes.row; first += kRowStep) {
    find_motions(nodes, first, motions);
    for (std::uint32_t left = motions.shown; left != 0; left &= left - 1)
      show(first, static_cast<std::size_t>(std::countr_zero(left)), motions);
  }
}

}  // namespace fbs
