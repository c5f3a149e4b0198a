#include "decoder/field/node_weights.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <vector>

#include "tests/unit/decoder/field/surround_grid.h"

namespace fbs {
namespace {

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
  const Surround surround(toy_setup(SurroundGrid::kWidth, SurroundGrid::kHeight).format, map, toy_state());
  const SurroundGrid grid;
  NodeWeights weights;
  for (int i = 0; i < 50; ++i) {
    const RegionWeights regions = random_regions(random);
    weights.set(grid.cover, point_weights(regions, surround.shares()), regions[0]);
    for (std::size_t k = 0; k < grid.cover.places().size(); ++k) {
      ASSERT_EQ(weights.at(k)[0] + weights.at(k)[1] + weights.at(k)[2], kNodeWeightOne) << k;
      for (std::size_t s = 0; s < 3; ++s) ASSERT_EQ(weights.at(k)[s] % (1 << kSurroundStepLog2), 0) << k << ": " << s;
    }
  }
}

TEST(NodeWeights, AreThoseOfTheRegionThatHasTheNode) {
  const SurroundGrid grid;
  RegionWeights regions;
  for (auto& region : regions) region = {0, 0, 256};
  regions[static_cast<std::size_t>(Region::kGround)] = {57, 0, 199};
  NodeWeights weights;
  weights.set(grid.cover, point_weights(regions, grid.surround.shares()), {});
  for (std::size_t k = 0; k < grid.cover.places().size(); ++k) {
    ASSERT_EQ(weights.at(k)[0], 64) << "57, rounded";
    ASSERT_EQ(weights.at(k)[2], 192);
  }
  weights.set(grid.cover, point_weights(regions, grid.surround.shares()), {}, kAtlasStepLog2);
  for (std::size_t k = 0; k < grid.cover.places().size(); ++k) ASSERT_EQ(weights.at(k)[0], 57);
}

// Half way between ground and hair.
TEST(NodeWeights, AreMixedByTheSharesOfRegions) {
  SurroundMap map{1, 1, {2, 2, 2, 2}, {0, 0, 0, 0}};
  const Surround surround(toy_setup(SurroundGrid::kWidth, SurroundGrid::kHeight).format, map, toy_state());
  std::vector<glm::ivec2> now;
  surround.project(toy_state(), now);
  NodeCover cover;
  cover.find(NodeGrid(SurroundGrid::kWidth, SurroundGrid::kHeight), surround.triangles(), now);
  RegionWeights regions;
  for (auto& region : regions) region = {0, 256};
  regions[static_cast<std::size_t>(Region::kHair)] = {101, 155};
  NodeWeights weights;
  weights.set(cover, point_weights(regions, surround.shares()), {});
  EXPECT_EQ(weights.at(22)[0], 48) << "50.5, rounded";
  EXPECT_EQ(weights.at(22)[1], 208);
}

// Sums of the first sources are rounded: 6, 12, 18, 24, 30 and 256.
TEST(NodeWeights, OfManySmallSourcesAFewKeepWhatAllHave) {
  const SurroundGrid grid;
  RegionWeights regions;
  for (auto& region : regions) region = {6, 6, 6, 6, 6, 226};
  NodeWeights weights;
  weights.set(grid.cover, point_weights(regions, grid.surround.shares()), {});
  for (std::size_t k = 0; k < grid.cover.places().size(); ++k)
    ASSERT_EQ(std::vector(weights.at(k), weights.at(k) + 6),
              (std::vector<std::uint16_t>{0, 16, 0, 16, 0, 224}))
        << k;
}

TEST(NodeWeights, OfNodesThatNothingCoversAreThoseFromOutside) {
  SurroundGrid grid;
  for (glm::ivec2& p : grid.now) p.x += 1 << 20;
  grid.find();
  PointWeights corners{2, {}};
  for (std::size_t k = 0; k < grid.surround.point_count(); ++k)
    corners.weights.insert(corners.weights.end(), {kMeshWeightOne, 0});
  NodeWeights weights;
  weights.set(grid.cover, corners, std::vector<std::int32_t>{99, 157});
  for (std::size_t k = 0; k < grid.cover.places().size(); ++k) {
    ASSERT_EQ(weights.at(k)[0], 99);
    ASSERT_EQ(weights.at(k)[1], 157);
  }
}

TEST(NodeWeights, OfASceneWithoutGeometryAreThoseOfTheGround) {
  NodeWeights weights;
  const NodeGrid grid(64, 64);
  weights.set(grid, std::vector<std::int32_t>{200, 56});
  for (std::size_t k = 0; k < grid.size(); ++k) {
    ASSERT_EQ(weights.at(k)[0], 200);
    ASSERT_EQ(weights.at(k)[1], 56);
  }
}

// Kernels take eight sources at once: what is behind the last one must not count.
TEST(NodeWeights, PlacesWithoutASourceAreZero) {
  const SurroundGrid grid;
  std::vector<std::int32_t> many(10, 1 << kSurroundStepLog2);
  many[9] = kNodeWeightOne - 9 * (1 << kSurroundStepLog2);
  RegionWeights of_many, of_two;
  for (auto& region : of_many) region = many;
  for (auto& region : of_two) region = {96, 160};
  NodeWeights weights;
  const auto expect_row = [&](const std::vector<std::int32_t>& expected, std::size_t row) {
    ASSERT_EQ(weights.row(), row);
    for (std::size_t k = 0; k < grid.cover.places().size(); ++k)
      for (std::size_t s = 0; s < row; ++s)
        ASSERT_EQ(weights.at(k)[s], s < expected.size() ? expected[s] : 0) << k << ": " << s;
  };
  SurroundGrid nowhere;  // nothing covers its nodes
  for (glm::ivec2& p : nowhere.now) p.x += 1 << 20;
  nowhere.find();
  for (int round = 0; round < 2; ++round) {
    for (const SurroundGrid* const in : {&grid, static_cast<const SurroundGrid*>(&nowhere)}) {
      weights.set(in->cover, point_weights(of_many, grid.surround.shares()), many);
      expect_row(many, 16);
      weights.set(in->cover, point_weights(of_two, grid.surround.shares()), of_two[0]);
      expect_row(of_two[0], 8);
    }
    weights.set(grid.cover.grid(), many);
    expect_row(many, 16);
    weights.set(grid.cover.grid(), of_two[0]);
    expect_row(of_two[0], 8);
  }
}

}  // namespace
}  // namespace fbs
