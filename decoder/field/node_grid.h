// The nodes of the surround: the corners of its patches. SPEC 10.3. Integers only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>

namespace fbs {

inline constexpr int kPatchSize = 8;  ///< luma samples from one node to the next

/// Patches are drawn four at a time, in blocks of 2 x 2.
inline constexpr int kBlockSize = 2 * kPatchSize;  ///< luma samples

/// The nodes of all blocks of a picture, row by row.
struct NodeGrid {
  int block_columns = 0, block_rows = 0;

  NodeGrid() = default;
  /// @param width, height  of the picture, luma samples
  NodeGrid(int width, int height)
      : block_columns((width + kBlockSize - 1) / kBlockSize),
        block_rows((height + kBlockSize - 1) / kBlockSize) {}

  [[nodiscard]] int columns() const { return 2 * block_columns + 1; }
  [[nodiscard]] int rows() const { return 2 * block_rows + 1; }
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(columns()) * static_cast<std::size_t>(rows());
  }
  /// The upper left node of a block.
  [[nodiscard]] std::size_t first_of_block(int column, int row) const {
    return 2 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(columns()) +
                static_cast<std::size_t>(column));
  }
  /// Position of node (0, 0) and distance to the next, 1/64 luma sample.
  static constexpr int kFirst = 32, kStepLog2 = 9;
  [[nodiscard]] static int place(int i) { return (i << kStepLog2) + kFirst; }

  friend bool operator==(const NodeGrid&, const NodeGrid&) = default;
};

}  // namespace fbs
