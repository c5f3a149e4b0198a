#include "decoder/field/node_cover.h"

#include <algorithm>

namespace fbs {
namespace {

constexpr std::int32_t kNone = -1;

/// Twice the area of the triangle from an edge to a point; positive on the inner side.
std::int64_t beside(glm::ivec2 from, glm::ivec2 to, glm::ivec2 p) {
  return (std::int64_t{from.y} - to.y) * (p.x - from.x) + (std::int64_t{to.x} - from.x) * (p.y - from.y);
}

/// The nodes lo..hi of an axis between two coordinates, both included.
struct NodeRange {
  int first, last;
  NodeRange(int low, int high, int count) {
    constexpr int kStep = 1 << NodeGrid::kStepLog2;
    first = std::max((low - NodeGrid::kFirst + kStep - 1) >> NodeGrid::kStepLog2, 0);
    last = std::min((high - NodeGrid::kFirst) >> NodeGrid::kStepLog2, count - 1);
  }
};

/// The test of one edge, from node to node.
struct EdgeTest {
  std::int64_t at_first, per_column, per_row;

  /// @param first  the first node, on the screen
  EdgeTest(glm::ivec2 from, glm::ivec2 to, glm::ivec2 first) {
    const std::int64_t by_x = std::int64_t{from.y} - to.y, by_y = std::int64_t{to.x} - from.x;
    const bool has_edge = by_x > 0 || (by_x == 0 && by_y > 0);  // left and top edges belong to the triangle
    at_first = beside(from, to, first) - (has_edge ? 0 : 1);
    per_column = by_x * (1 << NodeGrid::kStepLog2);
    per_row = by_y * (1 << NodeGrid::kStepLog2);
  }
};

NodePlace place_of(const MeshTriangle& corner, std::span<const glm::ivec2> points, glm::ivec2 node) {
  const glm::ivec2 p0 = points[corner[0]], p1 = points[corner[1]], p2 = points[corner[2]];
  const std::int64_t area = beside(p0, p1, p2);
  const auto share = [&](std::int64_t part) {
    return static_cast<std::int32_t>(part * (std::int64_t{1} << kCornerShareOneLog2) / area);
  };
  return {corner, {share(beside(p2, p0, node)), share(beside(p0, p1, node))}};
}

}  // namespace

void NodeCover::find(const NodeGrid& grid, std::span<const MeshTriangle> triangles,
                     std::span<const glm::ivec2> points) {
  grid_ = grid;
  owner_.assign(grid.size(), kNone);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const MeshTriangle& c = triangles[t];
    cover(static_cast<std::int32_t>(t), {points[c[0]], points[c[1]], points[c[2]]});
  }
  places_.resize(grid.size());
  for (int j = 0, k = 0; j < grid.rows(); ++j)
    for (int i = 0; i < grid.columns(); ++i, ++k)
      places_[k] = owner_[k] == kNone
                       ? NodePlace{{kNone, kNone, kNone}, {}}
                       : place_of(triangles[owner_[k]], points, {NodeGrid::place(i), NodeGrid::place(j)});
}

void NodeCover::take_nearest(std::span<const glm::ivec2> points) {
  for (int j = 0, k = 0; j < grid_.rows(); ++j) {
    for (int i = 0; i < grid_.columns(); ++i, ++k) {
      if (places_[k].is_covered()) continue;
      const glm::ivec2 node(NodeGrid::place(i), NodeGrid::place(j));
      const auto distance = [&](glm::ivec2 p) {
        const std::int64_t x = p.x - node.x, y = p.y - node.y;
        return x * x + y * y;
      };
      const auto nearer = [&](glm::ivec2 p, glm::ivec2 q) { return distance(p) < distance(q); };
      const auto nearest =
          static_cast<std::int32_t>(std::min_element(points.begin(), points.end(), nearer) - points.begin());
      places_[k] = {{nearest, nearest, nearest}, {}};
    }
  }
}

void NodeCover::cover(std::int32_t triangle, const std::array<glm::ivec2, 3>& at) {
  const auto [left, right] = std::minmax({at[0].x, at[1].x, at[2].x});
  const NodeRange columns(left, right, grid_.columns());
  const auto [top, bottom] = std::minmax({at[0].y, at[1].y, at[2].y});
  const NodeRange rows(top, bottom, grid_.rows());
  if (columns.first > columns.last || rows.first > rows.last || beside(at[0], at[1], at[2]) <= 0) return;
  const glm::ivec2 first(NodeGrid::place(columns.first), NodeGrid::place(rows.first));
  EdgeTest a(at[0], at[1], first), b(at[1], at[2], first), c(at[2], at[0], first);
  for (int j = rows.first; j <= rows.last; ++j) {
    std::int32_t* const owner = owner_.data() + static_cast<std::ptrdiff_t>(j) * grid_.columns();
    std::int64_t in_a = a.at_first, in_b = b.at_first, in_c = c.at_first;
    for (int i = columns.first; i <= columns.last; ++i) {
      if ((in_a | in_b | in_c) >= 0) owner[i] = triangle;
      in_a += a.per_column;
      in_b += b.per_column;
      in_c += c.per_column;
    }
    for (EdgeTest* e : {&a, &b, &c}) e->at_first += e->per_row;
  }
}

}  // namespace fbs
