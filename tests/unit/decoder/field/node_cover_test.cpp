#include "decoder/field/node_cover.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace fbs {
namespace {

struct Corner {
  std::int64_t x, y;
};

/// SPEC 10.6, word for word.
bool covers(const std::array<Corner, 3>& t, std::int64_t x, std::int64_t y) {
  const std::int64_t area = (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x);
  if (area <= 0) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const Corner from = t[k], to = t[(k + 1) % 3];
    const std::int64_t m = (from.y - to.y) * (x - from.x) + (to.x - from.x) * (y - from.y);
    const bool is_left = to.y < from.y, is_top = to.y == from.y && to.x > from.x;
    if (m < 0 || (m == 0 && !is_left && !is_top)) return false;
  }
  return true;
}

std::array<Corner, 3> at(const std::vector<glm::ivec2>& points, const MeshTriangle& t) {
  std::array<Corner, 3> out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = {points[t[k]].x, points[t[k]].y};
  return out;
}

/// The place that the last covering triangle gives the node.
NodePlace expected(const std::vector<MeshTriangle>& triangles, const std::vector<glm::ivec2>& points, int x,
                   int y) {
  NodePlace out{{-1, -1, -1}, {}};
  for (const MeshTriangle& triangle : triangles) {
    const auto t = at(points, triangle);
    if (!covers(t, x, y)) continue;
    const auto beside = [&](Corner from, Corner to) {
      return (from.y - to.y) * (x - from.x) + (to.x - from.x) * (y - from.y);
    };
    const std::int64_t area = (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x);
    out = {triangle,
           {static_cast<std::int32_t>(beside(t[2], t[0]) * 16384 / area),
            static_cast<std::int32_t>(beside(t[0], t[1]) * 16384 / area)}};
  }
  return out;
}

TEST(NodeCover, NodesBelongToTheLastTriangleThatCoversThem) {
  std::mt19937 random(1);
  const NodeGrid grid(100, 70);
  NodeCover cover;
  for (int i = 0; i < 100; ++i) {
    std::vector<glm::ivec2> points;
    const unsigned spread = i % 10 == 0 ? 1U << 22 : 160 * 64;
    const int offset = i % 10 == 0 ? 1 << 21 : 20 * 64;
    for (int k = 0; k < 30; ++k) {
      // Many on nodes, so that edges pass through others.
      glm::ivec2 p(static_cast<int>(random() % spread) - offset,
                   static_cast<int>(random() % spread) - offset);
      if (random() % 2 == 0) p = (p / 512) * 512 + 32;
      points.push_back(p);
    }
    std::vector<MeshTriangle> triangles;
    for (int k = 0; k < 40; ++k) {
      const auto any = [&] { return static_cast<std::int32_t>(random() % points.size()); };
      triangles.push_back({any(), any(), any()});
    }
    cover.find(grid, triangles, points);
    ASSERT_EQ(cover.places().size(), grid.size());
    for (int j = 0; j < grid.rows(); ++j) {
      for (int k = 0; k < grid.columns(); ++k) {
        const NodePlace e = expected(triangles, points, 512 * k + 32, 512 * j + 32);
        const NodePlace& found = cover.places()[static_cast<std::size_t>(j) * grid.columns() + k];
        ASSERT_EQ(found.corner, e.corner) << i << ": " << k << ',' << j;
        ASSERT_EQ(found.is_covered(), e.corner[0] >= 0);
        ASSERT_TRUE(!found.is_covered() || found.share == e.share) << i << ": " << k << ',' << j;
      }
    }
  }
}

TEST(NodeCover, BareNodesTakeTheNearestPointTheFirstOfSeveral) {
  const NodeGrid grid(64, 64);
  const std::vector<glm::ivec2> points{{0, 0}, {1600, 32}, {1600, 32}, {32, 1600}};
  NodeCover cover;
  cover.find(grid, std::vector<MeshTriangle>{{0, 1, 3}}, points);
  ASSERT_TRUE(cover.places()[0].is_covered());
  const NodePlace inside = cover.places()[0];
  cover.take_nearest(points);
  EXPECT_EQ(cover.places()[0].corner, inside.corner) << "what a triangle covers stays";
  EXPECT_EQ(cover.places()[0].share, inside.share);
  const NodePlace right = cover.places()[static_cast<std::size_t>(grid.columns()) - 1];
  EXPECT_EQ(right.corner, (MeshTriangle{1, 1, 1}));
  const NodePlace below = cover.places()[static_cast<std::size_t>(grid.rows() - 1) * grid.columns()];
  EXPECT_EQ(below.corner, (MeshTriangle{3, 3, 3}));
}

TEST(NodePlace, MeanIsLinearAndRoundedOnce) {
  const NodePlace place{{0, 1, 2}, {4096, 8192}};  // a quarter, a half
  EXPECT_EQ(place.mean(40, 80, 120), 90);
  EXPECT_EQ(place.mean(0, 1, 0), 0);
  EXPECT_EQ(place.mean(0, 2, 0), 1) << "a half is rounded up";
  EXPECT_EQ(place.mean(0, -2, 0), 0);
  EXPECT_EQ(place.mean(-(1 << 22), 1 << 22, 1 << 22), 1 << 21) << "the farthest points";
}

}  // namespace
}  // namespace fbs
