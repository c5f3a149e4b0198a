#include "decoder/atlas/atlas_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <utility>

#include "common/generic_head.h"
#include "common/picture.h"
#include "decoder/head/head_mesh.h"
#include "decoder/raster/row_runs.h"

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
    const AtlasLayout layout(generic_head(), eyes);
    for (const auto& t : layout.triangles) EXPECT_GT(twice_area(layout, t), 0) << t[0] << ' ' << eyes;
  }
}

// Their areas sum to the area within the skirt's outline: none overlap.
TEST(AtlasLayout, TrianglesDoNotOverlap) {
  const AtlasLayout layout(generic_head(), 160);
  std::int64_t sum = 0, within = 0;
  for (const auto& t : layout.triangles) sum += twice_area(layout, t);
  const std::size_t ring = generic_head().outline.size(), first = layout.points.size() - ring;
  for (std::size_t i = 0; i < ring; ++i) {
    const glm::ivec2 a = layout.points[first + i], b = layout.points[first + (i + 1) % ring];
    within += std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x;
  }
  EXPECT_EQ(sum, within);
}

// Another wire-frame may be turned over in the atlas, and its texture is read all the same.
TEST(AtlasLayout, TurnedOverBlocksAreDrawn) {
  WireFrameTables tables = tables_of(generic_head());
  std::int32_t right = 0;
  for (const glm::ivec2 p : tables.atlas) right = std::max(right, p.x);
  for (glm::ivec2& p : tables.atlas) p.x = right - p.x;
  const AtlasLayout layout(*make_wire_frame(tables).value(), 96);
  EXPECT_LT(twice_area(layout, layout.triangles.front()), 0);
  std::set<std::pair<int, int>> drawn;
  for (const glm::ivec2 block : layout.blocks) drawn.insert({block.x, block.y});
  for (const MeshTriangle& t : layout.triangles) {
    const glm::ivec2 middle = (layout.points[t[0]] + layout.points[t[1]] + layout.points[t[2]]) / 3;
    if (std::max({t[0], t[1], t[2]}) < static_cast<int>(layout.head_count)) {
      EXPECT_TRUE(drawn.contains({middle.x >> 10, middle.y >> 10})) << t[0];
    }
  }
}

// The size follows from the vertices that lie farthest to the right and below.
TEST(AtlasLayout, IsAsLargeAsItsWireFrameNeeds) {
  WireFrameTables tables = tables_of(generic_head());
  for (glm::ivec2& p : tables.atlas) p = p / 4;
  const AtlasLayout small(*make_wire_frame(tables).value(), 160), generic(generic_head(), 160);
  EXPECT_EQ(generic.width, (15365 * 160 / 64 / 64 / 16 + 1) * 16);
  EXPECT_EQ(generic.height, (17039 * 160 / 64 / 64 / 16 + 1) * 16);
  EXPECT_EQ(small.width, ((14792 / 4 + 573) * 160 / 64 / 64 / 16 + 1) * 16);
  EXPECT_EQ(small.height, ((16466 / 4 + 573) * 160 / 64 / 64 / 16 + 1) * 16);
}

TEST(AtlasLayout, HoldsTheHeadAndASkirtBeyondItsRing) {
  const AtlasLayout layout(generic_head(), 96);
  const std::size_t ring = generic_head().outline.size();
  ASSERT_EQ(kHeadAtlas.size(), generic_head_mesh().vertex_count);
  ASSERT_EQ(layout.points.size(), kHeadAtlas.size() + ring);
  ASSERT_EQ(layout.triangles.size(), generic_head_mesh().triangles.size() + 2 * ring);
  EXPECT_EQ(layout.width % 16, 0);
  EXPECT_EQ(layout.height % 16, 0);
  for (const glm::ivec2 p : layout.points) {
    EXPECT_TRUE(p.x >= 0 && p.x < 64 * layout.width) << p.x;
    EXPECT_TRUE(p.y >= 0 && p.y < 64 * layout.height) << p.y;
  }
  EXPECT_EQ(skirt_point({10, 20}, {20, 14}), glm::ivec2(25, 11));
  EXPECT_EQ(skirt_point({0, 0}, {1 << 21, -(1 << 21)}), glm::ivec2(1 << 21, -(1 << 21))) << "clamped";
}

/// Samples whose centre lies in a triangle of the head.
Plane head_samples(const AtlasLayout& layout) {
  Plane out(layout.width, layout.height);
  const auto triangles = std::span(layout.triangles).first(generic_head_mesh().triangles.size());
  for (const MeshTriangle& t : triangles) {
    const TriangleSetup setup({{{layout.points[t[0]]}, {layout.points[t[1]]}, {layout.points[t[2]]}}},
                              PlaneScale::kLuma);
    for (int y = 0; y < out.height; ++y) {
      const RowRun run = covered_run(setup.edges(), y, {0, 0, out.width, out.height});
      if (!run.empty()) std::fill_n(out.row(y) + run.first, run.count(), std::uint8_t{1});
    }
  }
  return out;
}

/// Whether any of the samples lies in a block, or within `margin` samples of it.
bool is_near(const Plane& samples, glm::ivec2 block, int margin) {
  for (int y = std::max(16 * block.y - margin, 0); y < std::min(16 * block.y + 16 + margin, samples.height);
       ++y)
    for (int x = std::max(16 * block.x - margin, 0); x < std::min(16 * block.x + 16 + margin, samples.width);
         ++x)
      if (samples.row(y)[x] != 0) return true;
  return false;
}

// Bilinear samples of chroma, two of luma wide, reach beyond the head; nothing else of its skirt is shown.
TEST(AtlasLayout, BlocksAreThoseOfWhichTheHeadShowsSomething) {
  for (const int eyes : {64, 80, 160}) {
    const AtlasLayout layout(generic_head(), eyes);
    std::set<std::pair<int, int>> listed;
    for (const glm::ivec2 b : layout.blocks) EXPECT_TRUE(listed.emplace(b.x, b.y).second);
    const NodeGrid& grid = layout.cover.grid();
    const Plane head = head_samples(layout);
    for (int row = 0; row < grid.block_rows; ++row) {
      for (int column = 0; column < grid.block_columns; ++column) {
        const bool is_listed = listed.erase({column, row}) == 1;
        EXPECT_TRUE(is_listed || !is_near(head, {column, row}, 2)) << eyes << ": " << column << ',' << row;
        EXPECT_TRUE(!is_listed || is_near(head, {column, row}, 5)) << eyes << ": " << column << ',' << row;
      }
    }
    EXPECT_TRUE(listed.empty()) << "none lies outside the atlas";
    for (const NodePlace& node : layout.cover.places()) EXPECT_TRUE(node.is_covered());
  }
  const AtlasLayout layout(generic_head(), 80);
  const NodeGrid& grid = layout.cover.grid();
  EXPECT_LT(layout.blocks.size(), static_cast<std::size_t>(grid.block_columns) * grid.block_rows);
}

// A quarter more samples than the head has in the picture, within what memory and time allow.
TEST(AtlasLayout, SizeFollowsTheHeadWithinLimits) {
  EXPECT_EQ(&generic_atlas_layout(scale(0)), &generic_atlas_layout(scale(51)));
  EXPECT_NE(&generic_atlas_layout(scale(51)), &generic_atlas_layout(scale(52)));
  EXPECT_EQ(&generic_atlas_layout(scale(52)), &generic_atlas_layout(scale(64)));
  EXPECT_LT(generic_atlas_layout(scale(64)).width, generic_atlas_layout(scale(65)).width);
  EXPECT_NE(&generic_atlas_layout(scale(115)), &generic_atlas_layout(scale(116)));
  EXPECT_EQ(&generic_atlas_layout(scale(116)), &generic_atlas_layout(scale(30000)));
}

}  // namespace
}  // namespace fbs
