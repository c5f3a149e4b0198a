#include "decoder/field/surround_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "decoder/field/node_kernels.h"
#include "tests/unit/decoder/every_target.h"
#include "tests/unit/decoder/field/surround_grid.h"

namespace fbs {
namespace {

using Points = std::vector<glm::ivec2>;

/// The field of sources that saw the grid's points at these positions.
SurroundField field_of(const SurroundGrid& grid, const std::vector<const Points*>& seen) {
  SurroundField out;
  out.set(grid.cover, seen, grid.now, {SurroundGrid::kWidth, SurroundGrid::kHeight});
  return out;
}
SurroundField field_of(const SurroundGrid& grid, const Points& seen) {
  return field_of(grid, std::vector<const Points*>{&seen});
}

State with_ground(std::array<std::int32_t, kSimilarityCount> ground) {
  State state = toy_state();
  state.ground = ground;
  return state;
}

TEST(SurroundField, OfAPatternSeenAsThePictureIsDoesNotMove) {
  const SurroundGrid grid;
  EXPECT_FALSE(field_of(grid, grid.now).moves());
}

TEST(SurroundField, OfADisplacedPatternIsItsDisplacementEverywhere) {
  const SurroundGrid grid;
  const SurroundField field = field_of(grid, grid.at(with_ground({130, -70, 0, 0})));
  EXPECT_TRUE(field.moves());
  for (std::size_t k = 0; k < grid.cover.places().size(); ++k)
    ASSERT_EQ(field.at(k, 0), glm::ivec2(130, -70)) << k;
}

TEST(SurroundField, IsLinearUnderASimilarity) {
  const SurroundGrid grid;
  const SurroundField field = field_of(grid, grid.at(with_ground({0, 0, 64, 0})));  // larger by 1/32
  const NodeGrid& nodes = grid.cover.grid();
  for (int j = 1; j < 16; ++j)  // in the margin all is displaced as the border is
    for (int i = 1; i < 20; ++i) {
      const glm::ivec2 by = field.at(static_cast<std::size_t>(j * nodes.columns() + i), 0);
      EXPECT_NEAR(by.x, (512 * i + 32 - 80 * 64) / 32.0, 2) << i;
      EXPECT_NEAR(by.y, (512 * j + 32 - 50 * 64) / 32.0, 2) << j;
    }
}

TEST(SurroundField, ReachesNoFartherOutThanAPaddedPlane) {
  const SurroundGrid grid;
  for (const int by : {-(1 << 20), -20000, 20000, 1 << 20}) {
    const SurroundField field = field_of(grid, grid.at(with_ground({by, -by, 0, 0})));
    const NodeGrid& nodes = grid.cover.grid();
    std::size_t k = 0;
    for (int j = 0; j < nodes.rows(); ++j)
      for (int i = 0; i < nodes.columns(); ++i, ++k) {
        const glm::ivec2 to = glm::ivec2(512 * i + 32, 512 * j + 32) + field.at(k, 0);
        EXPECT_EQ(to.x, by < 0 ? -24 * 64 : (SurroundGrid::kWidth + 24) * 64);
        EXPECT_EQ(to.y, by > 0 ? -24 * 64 : (SurroundGrid::kHeight + 24) * 64);
      }
  }
}

TEST(SurroundField, NodesThatNothingCoversDoNotMove) {
  SurroundGrid grid;
  for (glm::ivec2& p : grid.now) p.x += 1 << 20;
  grid.find();
  const SurroundField field = field_of(grid, grid.at(toy_state()));
  EXPECT_TRUE(field.moves());
  for (std::size_t k = 0; k < grid.cover.places().size(); ++k) ASSERT_EQ(field.at(k, 0), glm::ivec2(0));
}

// Source 1 is shown as it is, source 2 was seen as the picture is now.
TEST(SurroundField, EachSourceHasItsOwnDisplacement) {
  const SurroundGrid grid;
  std::vector<Points> seen;
  for (int s = 0; s < 11; ++s) seen.push_back(grid.at(with_ground({40 * s - 80, 7 * s - 14, 0, 0})));
  std::vector<const Points*> sources;
  for (const Points& p : seen) sources.push_back(&p);
  sources[1] = nullptr;
  SurroundField field = field_of(grid, std::vector<const Points*>(16, &seen[7]));  // it keeps its memory
  field.set(grid.cover, sources, grid.now, {SurroundGrid::kWidth, SurroundGrid::kHeight});
  EXPECT_EQ(field.row(), 16U);
  for (std::size_t k = 0; k < grid.cover.places().size(); ++k) {
    for (int s = 0; s < 16; ++s) {
      const bool still = s == 1 || s > 10;
      ASSERT_EQ(field.at(k, static_cast<std::size_t>(s)),
                still ? glm::ivec2(0) : glm::ivec2(40 * s - 80, 7 * s - 14))
          << s;
    }
    ASSERT_EQ(field.at(k) + 2 * field.row(), field.at(k + 1)) << "rows follow each other";
  }
}

TEST(SurroundField, OfSourcesThatDoNotMoveIsStill) {
  const SurroundGrid grid;
  const Points moved = grid.at(with_ground({64, 0, 0, 0}));
  EXPECT_FALSE(field_of(grid, std::vector<const Points*>{nullptr, nullptr}).moves());
  EXPECT_FALSE(field_of(grid, std::vector<const Points*>{nullptr, &grid.now}).moves());
  SurroundField field = field_of(grid, std::vector<const Points*>{nullptr, &moved});
  EXPECT_TRUE(field.moves());
  field.set_still();
  EXPECT_FALSE(field.moves());
  EXPECT_EQ(field.at(5, 1), glm::ivec2(0));
  field.set(grid.cover, std::vector<const Points*>{&moved}, grid.now,
            {SurroundGrid::kWidth, SurroundGrid::kHeight});
  EXPECT_EQ(field.at(5, 0), glm::ivec2(64, 0));
}

/// Grid points shared by two triangles, beyond a picture, of which two sources are displaced.
struct LargeCover {
  static constexpr int kSize = 1500;  ///< of the picture
  Points now{{-700, -700}, {100000, -700}, {-700, 100000}, {100000, 100000}};
  NodeCover cover;

  LargeCover() {
    const std::vector<MeshTriangle> triangles{{0, 1, 2}, {1, 3, 2}};
    cover.find(NodeGrid(kSize, kSize), triangles, now);
  }
  /// SPEC 10.3: the mean of the corners, as far as the limits of the picture allow.
  [[nodiscard]] int displacement(const NodePlace& place, int node, const Points& seen,
                                 int glm::ivec2::*axis) const {
    const auto d = [&](std::size_t corner) {
      const auto p = static_cast<std::size_t>(place.corner[corner]);
      return seen[p].*axis - now[p].*axis;
    };
    return std::clamp(node + place.mean(d(0), d(1), d(2)), -24 * 64, (kSize + 24) * 64) - node;
  }
};

// From kMaxShortDisplacement on there is no vector code: sums leave 32 bits.
TEST(SurroundField, LongDisplacementsFollowTheSameRule) {
  const LargeCover large;
  const NodeGrid& grid = large.cover.grid();
  on_every_target([&] {
    std::mt19937 random(1);
    for (const glm::ivec2 most : {glm::ivec2(300, 300),
                                  glm::ivec2(kMaxShortDisplacement - 1),
                                  {kMaxShortDisplacement, 300},
                                  {300, 1 << 17},
                                  {1 << 17, 300},
                                  glm::ivec2(1 << 20)}) {
      Points first = large.now, second = large.now;
      for (std::size_t p = 0; p < large.now.size(); ++p) {
        const int sign = p % 2 == 0 ? 1 : -1;  // far apart
        second[p] += glm::ivec2(sign * most.x, -sign * most.y);
        first[p] +=
            glm::ivec2(static_cast<int>(random() % 601) - 300, static_cast<int>(random() % 601) - 300);
      }
      SurroundField field;
      field.set(large.cover, std::vector<const Points*>{&first, &second}, large.now,
                glm::ivec2(LargeCover::kSize));
      std::size_t k = 0;
      int free = 0;
      for (int j = 0; j < grid.rows(); ++j) {
        for (int i = 0; i < grid.columns(); ++i, ++k) {
          const NodePlace& place = large.cover.places()[k];
          const glm::ivec2 node(512 * i + 32, 512 * j + 32);
          for (const std::size_t s : {0U, 1U}) {
            const Points& seen = s == 0 ? first : second;
            const glm::ivec2 expected(large.displacement(place, node.x, seen, &glm::ivec2::x),
                                      large.displacement(place, node.y, seen, &glm::ivec2::y));
            ASSERT_EQ(field.at(k, s), expected) << most.x << ',' << most.y << ": " << i << ',' << j;
            const glm::ivec2 to = node + expected;
            free += s == 1 && to.x > -24 * 64 && to.x < (LargeCover::kSize + 24) * 64 ? 1 : 0;
          }
        }
      }
      EXPECT_GT(free, 100) << "not all lie at the limit";
    }
  });
}

}  // namespace
}  // namespace fbs
