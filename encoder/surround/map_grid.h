// The grid of the surround's map and the labels of its points.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <glm/vec2.hpp>
#include <vector>

#include "bitstream/syntax.h"

namespace fbs {

/// Label of a point of the map: its share in the head's motion, and the body's share of the rest; quarters.
struct MapLabel {
  std::uint8_t head = 0, body = 0;
  friend bool operator==(const MapLabel&, const MapLabel&) = default;
};

/// All distinct labels: a point that wholly follows the head has no rest.
[[nodiscard]] inline const std::vector<MapLabel>& map_labels() {
  static const std::vector<MapLabel> all = [] {
    std::vector<MapLabel> out;
    for (int h = 0; h <= kFollowOne; ++h)
      for (int b = 0; b <= (h == kFollowOne ? 0 : kFollowOne); ++b)
        out.push_back({static_cast<std::uint8_t>(h), static_cast<std::uint8_t>(b)});
    return out;
  }();
  return all;
}

/// Distance of two labels in quarters: in the head's share, and in the body's share of what both leave to it.
[[nodiscard]] inline double distance(const MapLabel& a, const MapLabel& b) {
  const double head = std::abs(a.head - b.head);
  const double rest = std::min(kFollowOne - a.head, kFollowOne - b.head) / static_cast<double>(kFollowOne);
  return head + rest * std::abs(a.body - b.body);
}

/// columns x rows cells, whose corners are the points, row by row. A margin one cell wide surrounds the
/// picture and moves as the border does.
struct MapGrid {
  int columns = 0, rows = 0;

  [[nodiscard]] std::size_t stride() const { return columns + 1; }
  [[nodiscard]] std::size_t points() const { return stride() * (rows + 1); }

  /// Points that move a cell's corners, row by row.
  /// @param column, row  of the cell; -1 and columns, rows are the margin's
  [[nodiscard]] std::array<std::size_t, 4> corners_of(int column, int row) const {
    std::array<std::size_t, 4> k{};
    for (int i = 0; i < 4; ++i)
      k[i] = std::clamp(row + i / 2, 0, rows) * stride() + std::clamp(column + i % 2, 0, columns);
    return k;
  }

  /// Calls visit(point) for the neighbours left, right, above and below.
  template <class Visit>
  void for_neighbours(std::size_t k, Visit visit) const {
    const std::size_t c = k % stride();
    if (c > 0) visit(k - 1);
    if (c + 1 < stride()) visit(k + 1);
    if (k >= stride()) visit(k - stride());
    if (k + stride() < points()) visit(k + stride());
  }
};

/// A map with the same label at all points.
[[nodiscard]] inline SurroundMap uniform_map(const MapGrid& grid, MapLabel label) {
  SurroundMap map;
  map.columns = grid.columns;
  map.rows = grid.rows;
  map.head.assign(grid.points(), label.head);
  map.body.assign(grid.points(), label.body);
  return map;
}

}  // namespace fbs
