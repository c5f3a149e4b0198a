#include "encoder/surround/cell_cost.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/encoder/surround/painted_surround.h"

namespace fbs {
namespace {

constexpr MapLabel kHead{kFollowOne, 0}, kBody{0, kFollowOne}, kGround{0, 0};

/// The whole picture is ground, but for the head; it has moved by whole pixels, and the head by others.
struct Moved {
  Setup setup = toy_setup(kWidth, kHeight);
  SurroundObservations observations{setup.format};
  MapGrid grid{8, 6};

  explicit Moved(const Similarity& ground, glm::dvec2 head = {}) {
    observations.set_first(picture_of({}, 0, false), seen_state());
    State now = seen_state();
    for (std::size_t i = 0; i < kSimilarityCount; ++i) now.ground[i] = to_state(ground[i]);
    now.pose[kShiftX] += to_state(head.x);
    now.pose[kShiftY] += to_state(head.y);
    observations.add(picture_of({head, {}, ground}, 0, false), now);
  }
  [[nodiscard]] CellCost cost() const { return {setup, toy_geometry(), grid, observations}; }
};

std::array<MapLabel, 4> all(MapLabel l) {
  return {l, l, l, l};
}

TEST(CellCost, IsLeastUnderTheLayerThatTheCellGoesWith) {
  const Moved moved({6, 0, 0, 0});
  const CellCost cost = moved.cost();
  ASSERT_FALSE(cost.empty());
  for (const int column : {1, 6}) {
    EXPECT_LT(cost(column, 1, all(kGround)), 20) << column;
    EXPECT_GT(cost(column, 1, all(kBody)), 150) << column;
    EXPECT_GT(cost(column, 1, all(kHead)), 150) << column;
  }
}

TEST(CellCost, IsZeroWhereNothingMoves) {
  const Moved moved({});
  EXPECT_NEAR(moved.cost()(1, 1, all(kGround)), 0, 1e-6);
  EXPECT_NEAR(moved.cost()(1, 1, all(kBody)), 0, 1e-6);
}

TEST(CellCost, IsTruncated) {
  Moved moved({});
  Picture inverse = picture_of({}, 0, false);
  for (auto& s : inverse.y.samples) s = s < 128 ? 255 : 0;
  moved.observations.add(inverse, seen_state());
  const double cost = moved.cost()(1, 1, all(kGround));
  EXPECT_NEAR(cost, 45 * 45 / 2.0, 1) << "the mean of one picture that fits and one that does not";
}

TEST(CellCost, SaysNothingUnderTheHead) {
  Moved moved({6, 0, 0, 0});
  moved.grid = {24, 18};
  // A cell that lies wholly in the head, before and after it has moved with the ground.
  EXPECT_EQ(moved.cost()(11, 7, all(kGround)), 0);
  EXPECT_GT(moved.cost()(2, 7, all(kBody)), 0) << "else the test sees nothing";
}

TEST(CellCost, PointsSpanThePicture) {
  const Moved moved({});
  const CellCost cost = moved.cost();
  ASSERT_EQ(cost.points().size(), moved.grid.points());
  constexpr double kInset = 3;  // pixels: the border's points lie a little inside
  const glm::dvec2 first = cost.points().front(), last = cost.points().back();
  EXPECT_TRUE(first.x >= 0 && first.y >= 0 && last.x <= kWidth && last.y <= kHeight);
  EXPECT_TRUE(first.x < kInset && first.y < kInset && last.x > kWidth - kInset && last.y > kHeight - kInset);
}

}  // namespace
}  // namespace fbs
