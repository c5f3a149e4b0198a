// The picture round the face: a grid that moves with head, body and ground. SPEC 10.1. Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "bitstream/syntax.h"
#include "decoder/animate/region_shares.h"
#include "decoder/head/head_mesh.h"
#include "decoder/head/head_projection.h"

namespace fbs {

/// A map in which nothing moves: a single cell of ground.
[[nodiscard]] SurroundMap still_surround();

/// The grid of a SurroundMap, which begins a little inside the picture, with a margin: one more column and
/// row on each side, half a picture away. A margin point moves with the nearest border point.
class Surround {
 public:
  /// @param rest  the rest state, in which the grid is regular: the first pattern's
  Surround(const VideoFormat& format, SurroundMap map, const State& rest);

  /// Positions of the grid points, margin included, row by row, 1/64 pixel.
  void project(const State& state, std::vector<glm::ivec2>& out) const;

  /// A fixed place on the grid, carried by some cell.
  struct Place {
    glm::ivec2 rest;              ///< in the rest state, 1/64 pixel
    std::array<int, 4> corner{};  ///< grid points of the cell: row by row
    int across = 0, down = 0;     ///< position in the cell, 0..256
  };
  [[nodiscard]] Place place(glm::ivec2 rest) const;
  /// Where it lies when the grid points are at `moved`.
  [[nodiscard]] glm::ivec2 carried(const Place& place, std::span<const glm::ivec2> moved) const;

  /// A cell's corners, clockwise from the top left one.
  using Cell = std::array<int, 4>;
  /// Cells in drawing order: ground, body, head.
  [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }

  /// The halves of the cells, in the same order.
  [[nodiscard]] std::vector<MeshTriangle> triangles() const;

  /// Shares of the regions at each grid point, margin included.
  [[nodiscard]] const std::vector<RegionShares>& shares() const { return shares_; }
  /// The same at a fixed place: the mean of the cell's corners.
  [[nodiscard]] RegionShares shares_at(const Place& place) const;

  [[nodiscard]] std::size_t point_count() const { return points_.size(); }
  [[nodiscard]] const SurroundMap& map() const { return map_; }

 private:
  /// A grid point in the rest state, and the motion it follows.
  struct Point {
    glm::ivec2 rest;          ///< 1/64 pixel
    glm::ivec2 from_head;     ///< base relative to the head's origin, 1/256 eye distance
    std::int32_t head, body;  ///< shares in 1/kFollowOne
    int base;                 ///< the point itself; in the margin, the border point it follows
  };

  void place_points(const VideoFormat& format);
  void order_cells();
  [[nodiscard]] int index(int column, int row) const;

  SurroundMap map_;
  State rest_;
  std::vector<Point> points_;
  std::vector<Cell> cells_;
  std::vector<RegionShares> shares_;
};

}  // namespace fbs
