#include "decoder/field/surround_field.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr int kWidth = 160, kHeight = 128;

/// A grid of 8 x 8 cells in a toy scene, in some state.
struct Grid {
  SurroundMap map = even_surround(8, 8, 0);
  Surround surround{toy_setup(kWidth, kHeight).format, map, toy_state()};
  std::vector<glm::ivec2> now = at(toy_state());
  NodeCover cover;

  explicit Grid(SurroundMap m = even_surround(8, 8, 0)) : map(std::move(m)) { find(); }
  [[nodiscard]] std::vector<glm::ivec2> at(const State& state) const {
    std::vector<glm::ivec2> out;
    surround.project(state, out);
    return out;
  }
  void find() { cover.find(NodeGrid(kWidth, kHeight), surround.triangles(), now); }
  [[nodiscard]] SourceField field(const std::vector<glm::ivec2>& seen) const {
    SourceField out;
    displace(cover, seen, now, kWidth, kHeight, out);
    return out;
  }
};

State with_ground(std::array<std::int32_t, kSimilarityCount> ground) {
  State state = toy_state();
  state.ground = ground;
  return state;
}

TEST(SurroundField, OfAPatternSeenAsThePictureIsDoesNotMove) {
  const Grid grid;
  EXPECT_FALSE(grid.field(grid.now).moves);
}

TEST(SurroundField, OfADisplacedPatternIsItsDisplacementEverywhere) {
  const Grid grid;
  const SourceField field = grid.field(grid.at(with_ground({130, -70, 0, 0})));
  EXPECT_TRUE(field.moves);
  ASSERT_EQ(field.displacement.size(), grid.cover.places().size());
  for (const glm::ivec2 d : field.displacement) ASSERT_EQ(d, glm::ivec2(130, -70));
}

TEST(SurroundField, IsLinearUnderASimilarity) {
  const Grid grid;
  const SourceField field = grid.field(grid.at(with_ground({0, 0, 64, 0})));  // larger by 1/32
  const NodeGrid& nodes = grid.cover.grid();
  for (int j = 1; j < 16; ++j)  // in the margin all is displaced as the border is
    for (int i = 1; i < 20; ++i) {
      const int k = j * nodes.columns() + i;
      EXPECT_NEAR(field.displacement[k].x, (512 * i + 32 - 80 * 64) / 32.0, 2) << i;
      EXPECT_NEAR(field.displacement[k].y, (512 * j + 32 - 50 * 64) / 32.0, 2) << j;
    }
}

TEST(SurroundField, ReachesNoFartherOutThanAPaddedPlane) {
  const Grid grid;
  for (const int by : {-(1 << 20), 1 << 20}) {
    const SourceField field = grid.field(grid.at(with_ground({by, -by, 0, 0})));
    const NodeGrid& nodes = grid.cover.grid();
    for (int j = 0, k = 0; j < nodes.rows(); ++j)
      for (int i = 0; i < nodes.columns(); ++i, ++k) {
        EXPECT_EQ(512 * i + 32 + field.displacement[k].x, by < 0 ? -24 * 64 : (kWidth + 24) * 64);
        EXPECT_EQ(512 * j + 32 + field.displacement[k].y, by > 0 ? -24 * 64 : (kHeight + 24) * 64);
      }
  }
}

TEST(SurroundField, NodesThatNothingCoversDoNotMove) {
  Grid grid;
  for (glm::ivec2& p : grid.now) p.x += 1 << 20;
  grid.find();
  const SourceField field = grid.field(grid.at(toy_state()));
  EXPECT_TRUE(field.moves);
  for (const glm::ivec2 d : field.displacement) ASSERT_EQ(d, glm::ivec2(0));
}

/// Three sources with random weights in each region.
RegionWeights random_regions(std::mt19937& random) {
  RegionWeights out;
  for (auto& region : out) {
    const auto a = static_cast<std::int32_t>(random() % 257),
               b = static_cast<std::int32_t>(random() % static_cast<unsigned>(257 - a));
    region = {a, b, kBlendOne - a - b};
  }
  return out;
}

TEST(NodeWeights, SumToOneAtEveryNode) {
  std::mt19937 random(2);
  SurroundMap map = even_surround(8, 8, 0);
  for (auto& f : map.head) f = static_cast<std::uint8_t>(random() % 5);
  for (auto& g : map.body) g = static_cast<std::uint8_t>(random() % 5);
  const Surround surround(toy_setup(kWidth, kHeight).format, map, toy_state());
  const Grid grid;
  NodeWeights weights;
  for (int i = 0; i < 50; ++i) {
    const RegionWeights regions = random_regions(random);
    weights.set(grid.cover, point_weights(regions, surround.shares()), regions[0]);
    for (std::size_t k = 0; k < grid.cover.places().size(); ++k)
      ASSERT_EQ(weights.of(0)[k] + weights.of(1)[k] + weights.of(2)[k], kNodeWeightOne) << k;
  }
}

TEST(NodeWeights, AreThoseOfTheRegionThatHasTheNode) {
  const Grid grid;
  RegionWeights regions;
  for (auto& region : regions) region = {0, 0, 256};
  regions[static_cast<std::size_t>(Region::kGround)] = {57, 0, 199};
  NodeWeights weights;
  weights.set(grid.cover, point_weights(regions, grid.surround.shares()), {});
  for (std::size_t k = 0; k < grid.cover.places().size(); ++k) {
    ASSERT_EQ(weights.of(0)[k], 57);
    ASSERT_EQ(weights.of(2)[k], 199);
  }
}

// Half way between ground and hair.
TEST(NodeWeights, AreMixedByTheSharesOfRegions) {
  SurroundMap map{1, 1, {2, 2, 2, 2}, {0, 0, 0, 0}};
  const Surround surround(toy_setup(kWidth, kHeight).format, map, toy_state());
  std::vector<glm::ivec2> now;
  surround.project(toy_state(), now);
  NodeCover cover;
  cover.find(NodeGrid(kWidth, kHeight), surround.triangles(), now);
  RegionWeights regions;
  for (auto& region : regions) region = {0, 256};
  regions[static_cast<std::size_t>(Region::kHair)] = {101, 155};
  NodeWeights weights;
  weights.set(cover, point_weights(regions, surround.shares()), {});
  EXPECT_EQ(weights.of(0)[22], 50) << "rounded down";
  EXPECT_EQ(weights.of(1)[22], 206) << "the largest takes the rest";
}

TEST(NodeWeights, OfNodesThatNothingCoversAreThoseFromOutside) {
  Grid grid;
  for (glm::ivec2& p : grid.now) p.x += 1 << 20;
  grid.find();
  PointWeights corners{2, {}};
  for (std::size_t k = 0; k < grid.surround.point_count(); ++k)
    corners.weights.insert(corners.weights.end(), {kMeshWeightOne, 0});
  NodeWeights weights;
  weights.set(grid.cover, corners, std::vector<std::int32_t>{99, 157});
  for (std::size_t k = 0; k < grid.cover.places().size(); ++k) {
    ASSERT_EQ(weights.of(0)[k], 99);
    ASSERT_EQ(weights.of(1)[k], 157);
  }
}

TEST(NodeWeights, OfASceneWithoutGeometryAreThoseOfTheGround) {
  NodeWeights weights;
  const NodeGrid grid(64, 64);
  weights.set(grid, std::vector<std::int32_t>{200, 56});
  for (std::size_t k = 0; k < grid.size(); ++k) {
    ASSERT_EQ(weights.of(0)[k], 200);
    ASSERT_EQ(weights.of(1)[k], 56);
  }
}

}  // namespace
}  // namespace fbs
