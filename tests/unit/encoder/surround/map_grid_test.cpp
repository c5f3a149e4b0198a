#include "encoder/surround/map_grid.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

TEST(MapLabels, AreAllThatDiffer) {
  const auto& labels = map_labels();
  EXPECT_EQ(labels.size(), static_cast<std::size_t>(kFollowOne * (kFollowOne + 1) + 1));
  for (std::size_t i = 0; i < labels.size(); ++i)
    for (std::size_t j = 0; j < labels.size(); ++j)
      EXPECT_EQ(distance(labels[i], labels[j]) == 0, i == j) << i << ' ' << j;
}

TEST(MapLabels, DistanceIsSymmetricAndCountsTheBodyOnlyInTheRest) {
  const MapLabel head{kFollowOne, 0}, body{0, kFollowOne}, ground{0, 0}, half{kFollowOne / 2, kFollowOne};
  EXPECT_EQ(distance(head, body), kFollowOne);
  EXPECT_EQ(distance(head, ground), kFollowOne);
  EXPECT_EQ(distance(body, ground), kFollowOne);
  EXPECT_EQ(distance(ground, half), distance(half, ground));
  EXPECT_EQ(distance(ground, half), kFollowOne / 2 + 0.5 * kFollowOne);
}

TEST(MapGrid, MarginsCornersAreTheBorders) {
  const MapGrid grid{3, 2};
  EXPECT_EQ(grid.points(), 12U);
  EXPECT_EQ(grid.corners_of(0, 0), (std::array<std::size_t, 4>{0, 1, 4, 5}));
  EXPECT_EQ(grid.corners_of(-1, -1), (std::array<std::size_t, 4>{0, 0, 0, 0}));
  EXPECT_EQ(grid.corners_of(3, 1), (std::array<std::size_t, 4>{7, 7, 11, 11}));
}

TEST(MapGrid, NeighboursDoNotWrap) {
  const MapGrid grid{3, 2};
  const auto of = [&](std::size_t k) {
    std::vector<std::size_t> out;
    grid.for_neighbours(k, [&](std::size_t i) { out.push_back(i); });
    return out;
  };
  EXPECT_EQ(of(0), (std::vector<std::size_t>{1, 4}));
  EXPECT_EQ(of(5), (std::vector<std::size_t>{4, 6, 1, 9}));
  EXPECT_EQ(of(11), (std::vector<std::size_t>{10, 7}));
}

}  // namespace
}  // namespace fbs
