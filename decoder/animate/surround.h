// The picture round the face: a grid that moves with head, body and ground. SPEC 10.1. Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "bitstream/syntax.h"
#include "decoder/animate/head_projection.h"

namespace fbs {

/// The grid of a SurroundMap, which begins a little inside the picture, with a margin: one more column and
/// row on each side, half a picture away, which move as the outermost do and show the same, so that what
/// comes in from outside repeats what is near.
class Surround {
 public:
  /// @param seen  state of pattern 0, in which the grid is regular
  Surround(const VideoFormat& format, SurroundMap map, const State& seen);

  /// Positions of the grid points, margin included, row by row, 1/64 pixel.
  void project(const State& state, std::vector<glm::ivec2>& out) const;

  /// What the pattern shows at the grid points: where they are in the seen state; in the margin, what the
  /// outermost show. 1/64 pixel.
  [[nodiscard]] const std::vector<glm::ivec2>& texture() const { return texture_; }

  /// A place that some cell carries.
  struct Place {
    glm::ivec2 seen;              ///< in the seen state, 1/64 pixel
    std::array<int, 4> corner{};  ///< grid points of the cell: row by row
    int across = 0, down = 0;     ///< place in the cell, 0..256
  };
  [[nodiscard]] Place place(glm::ivec2 seen) const;
  /// Where it is when the grid points are at `moved`.
  [[nodiscard]] glm::ivec2 carried(const Place& place, std::span<const glm::ivec2> moved) const;

  /// A cell's corners, clockwise from the top left one.
  using Cell = std::array<int, 4>;
  /// In the order in which they are drawn: ground, body, head.
  [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }

  [[nodiscard]] const SurroundMap& map() const { return map_; }

 private:
  /// A grid point: where it is in the seen state, and how it moves.
  struct Point {
    glm::ivec2 seen;          ///< 1/64 pixel
    glm::ivec2 from_head;     ///< the same less the head's origin, in 1/256 eye distance
    std::int32_t head, body;  ///< shares, of kFollowOne
  };

  [[nodiscard]] std::size_t index(int column, int row) const;

  SurroundMap map_;
  State seen_;
  std::vector<Point> points_;
  std::vector<glm::ivec2> texture_;
  std::vector<Cell> cells_;
};

}  // namespace fbs
