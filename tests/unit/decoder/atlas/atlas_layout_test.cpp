#include "decoder/atlas/atlas_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "decoder/head/head_mesh.h"

namespace fbs {
namespace {

/// Q16 samples per eye distance.
constexpr std::int64_t scale(double samples) {
  return static_cast<std::int64_t>(samples * 65536);
}

std::int64_t twice_area(const AtlasLayout& layout, const MeshTriangle& t) {
  const glm::ivec2 a = layout.points[t[0]], b = layout.points[t[1]], c = layout.points[t[2]];
  return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
}

// Whatever a face does, each triangle of the atlas has room and faces the viewer.
TEST(AtlasLayout, TrianglesAreClockwiseAtEverySize) {
  for (int eyes = 64; eyes <= 160; eyes += 16) {
    const AtlasLayout layout(eyes);
    for (const auto& t : layout.triangles) EXPECT_GT(twice_area(layout, t), 0) << t[0] << ' ' << eyes;
  }
}

// Their areas sum to that within the outline of the skirt: none lies on another.
TEST(AtlasLayout, TrianglesDoNotOverlap) {
  const AtlasLayout layout(160);
  std::int64_t sum = 0, within = 0;
  for (const auto& t : layout.triangles) sum += twice_area(layout, t);
  const std::size_t ring = generic_head().outline.size(), first = layout.points.size() - ring;
  for (std::size_t i = 0; i < ring; ++i) {
    const glm::ivec2 a = layout.points[first + i], b = layout.points[first + (i + 1) % ring];
    within += std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x;
  }
  EXPECT_EQ(sum, within);
}

TEST(AtlasLayout, HoldsTheHeadAndASkirtBeyondItsRing) {
  const AtlasLayout layout(96);
  const std::size_t ring = generic_head().outline.size();
  ASSERT_EQ(kAtlasTableSize, head_mesh().vertex_count);
  ASSERT_EQ(layout.points.size(), kAtlasTableSize + ring);
  ASSERT_EQ(layout.triangles.size(), head_mesh().triangles.size() + 2 * ring);
  EXPECT_EQ(layout.width % 16, 0);
  EXPECT_EQ(layout.height % 16, 0);
  for (const glm::ivec2 p : layout.points) {
    EXPECT_TRUE(p.x >= 0 && p.x < 64 * layout.width) << p.x;
    EXPECT_TRUE(p.y >= 0 && p.y < 64 * layout.height) << p.y;
  }
  EXPECT_EQ(skirt_point({10, 20}, {20, 14}), glm::ivec2(25, 11));
  EXPECT_EQ(skirt_point({0, 0}, {1 << 21, -(1 << 21)}), glm::ivec2(1 << 21, -(1 << 21))) << "clamped";
}

TEST(AtlasLayout, BlocksAreThoseThatTrianglesReach) {
  const AtlasLayout layout(80);
  std::set<std::pair<int, int>> listed;
  for (const glm::ivec2 b : layout.blocks) EXPECT_TRUE(listed.emplace(b.x, b.y).second);
  const NodeGrid& grid = layout.cover.grid();
  ASSERT_LE(listed.size(), static_cast<std::size_t>(grid.block_columns) * grid.block_rows);
  for (const glm::ivec2 p : layout.points) EXPECT_TRUE(listed.contains({p.x / 1024, p.y / 1024}));
  for (const auto& t : layout.triangles) {
    const glm::ivec2 middle = (layout.points[t[0]] + layout.points[t[1]] + layout.points[t[2]]) / 3;
    EXPECT_TRUE(listed.contains({middle.x / 1024, middle.y / 1024}));
  }
  for (const NodePlace& node : layout.cover.places()) EXPECT_TRUE(node.is_covered());
}

// A quarter more samples than the head has in the picture, within what memory and time allow.
TEST(AtlasLayout, SizeFollowsTheHeadWithinLimits) {
  EXPECT_EQ(&atlas_layout(scale(0)), &atlas_layout(scale(51)));
  EXPECT_NE(&atlas_layout(scale(51)), &atlas_layout(scale(52)));
  EXPECT_EQ(&atlas_layout(scale(52)), &atlas_layout(scale(64)));
  EXPECT_LT(atlas_layout(scale(64)).width, atlas_layout(scale(65)).width);
  EXPECT_NE(&atlas_layout(scale(115)), &atlas_layout(scale(116)));
  EXPECT_EQ(&atlas_layout(scale(116)), &atlas_layout(scale(30000)));
}

}  // namespace
}  // namespace fbs
