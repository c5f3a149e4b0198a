#include "decoder/animate/surround.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/unit/decoder/head/plain_projection.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr int kWidth = 160, kHeight = 128;
constexpr int kInset = 2 * 64;  ///< from the picture's border to the grid's; SPEC 10.1

Surround surround_of(SurroundMap map, const State& seen = toy_state()) {
  return {toy_setup(kWidth, kHeight).format, std::move(map), seen};
}

/// Five by four cells of 32 by 32 pixels.
Surround even_cells() {
  const int border = 2 * kInset / 64;
  return {toy_setup(kWidth + border, kHeight + border).format, even_surround(5, 4, 0), toy_state()};
}

std::vector<glm::ivec2> projected(const Surround& surround, const State& state) {
  std::vector<glm::ivec2> out;
  surround.project(state, out);
  return out;
}

/// Displacement of each point since the rest state, margin included.
std::vector<glm::ivec2> displacements(const Surround& surround, const State& state,
                                      const State& seen = toy_state()) {
  const auto before = projected(surround, seen);
  auto after = projected(surround, state);
  for (std::size_t k = 0; k < after.size(); ++k) after[k] -= before[k];
  return after;
}

/// The same shares everywhere, border included.
SurroundMap whole_map(int columns, int rows, int head, int body = 0) {
  SurroundMap map = even_surround(columns, rows, head, body);
  map.head.assign(map.head.size(), static_cast<std::uint8_t>(head));
  map.body.assign(map.body.size(), static_cast<std::uint8_t>(body));
  return map;
}

SurroundMap random_map(std::mt19937& random, int columns, int rows) {
  SurroundMap map = whole_map(columns, rows, 0);
  for (auto& v : map.head) v = static_cast<std::uint8_t>(random() % (kFollowOne + 1));
  for (std::size_t k = 0; k < map.body.size(); ++k)
    map.body[k] = map.head[k] == kFollowOne ? 0 : static_cast<std::uint8_t>(random() % (kFollowOne + 1));
  return map;
}

/// Column or row of a point, margin included, as the column or row of the picture's point it moves with.
int on_picture(int place, int last) {
  return std::clamp(place - 1, 0, last);
}

TEST(Surround, RestStateGivesTheRegularGridAndItsMargin) {
  State seen = toy_state(70, 60);
  seen.pose[kYaw] = 900;
  seen.pose[kRoll] = -1500;
  const Surround surround(toy_setup(165, 127).format, whole_map(7, 5, kFollowOne), seen);
  const auto grid = projected(surround, seen);
  ASSERT_EQ(grid.size(), 10U * 8U);
  for (int r = -1; r <= 6; ++r) {
    for (int c = -1; c <= 8; ++c) {
      const int x = kInset + (c < 0   ? -165 * 32
                              : c > 7 ? 165 * 96 - 2 * kInset
                                      : (165 * 64 - 2 * kInset) * c / 7);
      const int y = kInset + (r < 0   ? -127 * 32
                              : r > 5 ? 127 * 96 - 2 * kInset
                                      : (127 * 64 - 2 * kInset) * r / 5);
      EXPECT_EQ(grid[(r + 1) * 10 + c + 1], glm::ivec2(x, y)) << c << ' ' << r;
    }
  }
}

TEST(Surround, FollowsAShiftOfTheHeadByItsShare) {
  for (int share = 0; share <= kFollowOne; ++share) {
    const auto moved = displacements(surround_of(even_surround(8, 8, share)), toy_state(88, 46));
    for (int r = 0; r <= 10; ++r) {
      for (int c = 0; c <= 10; ++c) {
        const bool inside = r > 1 && c > 1 && r < 9 && c < 9;
        const glm::ivec2 expected = inside ? glm::ivec2(8 * 16 * share, -4 * 16 * share) : glm::ivec2(0);
        EXPECT_EQ(moved[r * 11 + c], expected) << r << ' ' << c;
      }
    }
  }
}

TEST(Surround, HeadMayMoveTheBorderToo) {
  for (const glm::ivec2 d : displacements(surround_of(whole_map(4, 4, kFollowOne)), toy_state(88, 46)))
    EXPECT_EQ(d, glm::ivec2(8 * 64, -4 * 64));
}

TEST(Surround, GroundMovesAllThatFollowsNeitherHeadNorBody) {
  State state = toy_state();
  state.ground = {200, -64, 0, 0};
  for (const glm::ivec2 d : displacements(surround_of(whole_map(6, 5, 0)), state))
    EXPECT_EQ(d, glm::ivec2(200, -64)) << "margin and border, too";
  for (const glm::ivec2 d : displacements(surround_of(whole_map(6, 5, 0, kFollowOne)), state))
    EXPECT_EQ(d, glm::ivec2(0)) << "body stays";
  for (const glm::ivec2 d : displacements(surround_of(whole_map(6, 5, kFollowOne)), state))
    EXPECT_EQ(d, glm::ivec2(0)) << "so does the head";
}

TEST(Surround, PointsShareBetweenBodyAndGround) {
  State state = toy_state();
  state.body = {400, 80, 0, 0};
  state.ground = {0, -160, 0, 0};
  for (int body = 0; body <= kFollowOne; ++body)
    for (const glm::ivec2 d : displacements(surround_of(whole_map(6, 5, 0, body)), state))
      EXPECT_EQ(d, glm::ivec2(100 * body, -160 + 60 * body));
}

// What does not follow the head is shared between body and ground.
TEST(Surround, HeadTakesItsShareOfBodyAndGround) {
  State state = toy_state(84, 50);  // 256
  state.body = {0, 320, 0, 0};
  for (const glm::ivec2 d : displacements(surround_of(whole_map(4, 4, 1, kFollowOne)), state))
    EXPECT_EQ(d, glm::ivec2(64, 240));
  for (const glm::ivec2 d : displacements(surround_of(whole_map(4, 4, 3, 2)), state))
    EXPECT_EQ(d, glm::ivec2(192, 40));
}

// Scale and rotation are the displacement of a point one eye distance, here 32 pixels, from the head's
// origin.
TEST(Surround, BodyAndGroundScaleAndRotateAboutTheHeadsOrigin) {
  const Surround ground = surround_of(whole_map(10, 8, 0)),
                 body = surround_of(whole_map(10, 8, 0, kFollowOne));
  for (const auto& [scale, rotation] : {std::pair{640, 0}, {0, 640}, {-300, 500}}) {
    State state = toy_state();
    state.ground = {30, -70, scale, rotation};
    const auto moved = displacements(ground, state);
    const auto before = projected(ground, toy_state());
    for (int r = 1; r <= 9; ++r) {
      for (int c = 1; c <= 11; ++c) {
        const auto k = static_cast<std::size_t>(r * 13 + c);
        const glm::dvec2 d = (glm::dvec2(before[k]) / 64.0 - glm::dvec2(80, 50)) / 32.0;
        // The distance is in 1/256 eye distance.
        const double tolerance = 1 + (std::abs(scale) + std::abs(rotation)) / 256.0;
        EXPECT_NEAR(moved[k].x, 30 + scale * d.x - rotation * d.y, tolerance);
        EXPECT_NEAR(moved[k].y, -70 + scale * d.y + rotation * d.x, tolerance);
      }
    }
    std::swap(state.body, state.ground);
    EXPECT_EQ(displacements(body, state), moved);
  }
}

// Content that comes in from outside repeats the border's samples.
TEST(Surround, MarginMovesAsTheBorderDoes) {
  std::mt19937 random(2);
  for (int i = 0; i < 60; ++i) {
    const Surround surround = surround_of(random_map(random, 5, 4));
    State state = toy_state(75 + static_cast<int>(random() % 10), 47 + static_cast<int>(random() % 7));
    state.pose[kYaw] = static_cast<int>(random() % 4000) - 2000;
    for (auto* similarity : {&state.body, &state.ground})
      for (auto& n : *similarity) n = static_cast<int>(random() % 800) - 400;
    const auto moved = displacements(surround, state);
    for (int r = 0; r <= 6; ++r)
      for (int c = 0; c <= 7; ++c)
        ASSERT_EQ(moved[r * 8 + c], moved[(on_picture(r, 4) + 1) * 8 + on_picture(c, 5) + 1])
            << r << ' ' << c;
  }
}

// A point of the surround that wholly follows the head moves with the head frame's plane z = 0.
TEST(Surround, WhatFollowsWhollyMovesAsTheHeadsPlane) {
  std::mt19937 random(5);
  for (int i = 0; i < 200; ++i) {
    State seen = toy_state(), now = toy_state();
    for (State* s : {&seen, &now}) {
      for (const int k : {kPitch, kYaw, kRoll}) s->pose[k] = static_cast<int>(random() % 10000) - 5000;
      s->pose[kShiftX] += static_cast<int>(random() % 2000) - 1000;
      s->pose[kShiftY] += static_cast<int>(random() % 2000) - 1000;
      s->pose[kLogScale] += static_cast<int>(random() % 2000) - 1000;
    }
    const Surround surround = surround_of(whole_map(6, 6, kFollowOne), seen);
    const auto before = projected(surround, seen), after = projected(surround, now);
    const PlainProjection from(head_pose(seen)), to(head_pose(now));
    const glm::dmat2 a(glm::dvec2(from.rotation[0]) * from.scale, glm::dvec2(from.rotation[1]) * from.scale);
    const double det = a[0].x * a[1].y - a[1].x * a[0].y;
    for (std::size_t r = 1; r <= 7; ++r) {
      for (std::size_t c = 1; c <= 7; ++c) {
        const std::size_t k = r * 9 + c;
        const glm::dvec2 d = glm::dvec2(before[k]) / 64.0 - from.shift;
        const glm::dvec3 plane((a[1].y * d.x - a[1].x * d.y) / det, (-a[0].y * d.x + a[0].x * d.y) / det, 0);
        const glm::dvec2 expected = to(plane);
        ASSERT_NEAR(after[k].x / 64.0, expected.x, 1.0 / 16);
        ASSERT_NEAR(after[k].y / 64.0, expected.y, 1.0 / 16);
      }
    }
  }
}

TEST(Surround, NothingFollowsAHeadThatIsSeenFromTheSideAtRest) {
  State seen = toy_state(), now = toy_state(90, 50);
  seen.pose[kYaw] = 16000;
  for (const glm::ivec2 d : displacements(surround_of(whole_map(6, 6, kFollowOne), seen), now, seen))
    EXPECT_EQ(d, glm::ivec2(0));
}

TEST(Surround, CellsCoverTheGridOnceEach) {
  std::mt19937 random(3);
  const Surround surround = surround_of(random_map(random, 6, 4));
  std::set<int> first;
  for (const Surround::Cell& cell : surround.cells()) {
    first.insert(cell[0]);
    EXPECT_EQ(cell, (Surround::Cell{cell[0], cell[0] + 1, cell[0] + 10, cell[0] + 9})) << "clockwise";
    EXPECT_TRUE(cell[0] % 9 < 8 && cell[0] / 9 < 6);
  }
  EXPECT_EQ(surround.cells().size(), 8U * 6U);
  EXPECT_EQ(first.size(), surround.cells().size());
}

// SPEC 10.1: nearer cells are drawn later.
TEST(Surround, DrawsGroundThenBodyThenHead) {
  std::mt19937 random(4);
  for (int i = 0; i < 20; ++i) {
    const SurroundMap map = random_map(random, 6, 4);
    const Surround surround = surround_of(map);
    std::vector<std::array<int, 2>> order;  // nearness, place
    for (const Surround::Cell& cell : surround.cells()) {
      int head = 0, body = 0;
      for (const int point : cell) {
        const auto k = static_cast<std::size_t>(on_picture(point / 9, 4) * 7 + on_picture(point % 9, 6));
        head += map.head[k];
        body += map.body[k];
      }
      order.push_back({2 * kFollowOne * head + body, cell[0]});
    }
    EXPECT_TRUE(std::is_sorted(order.begin(), order.end())) << i;
  }
  // A shoulder behind hair: whole cells of each.
  SurroundMap three = whole_map(6, 1, 0);
  for (const std::size_t row : {0U, 7U}) {
    three.head[row] = three.head[row + 1] = kFollowOne;
    three.body[row + 2] = three.body[row + 3] = kFollowOne;
  }
  const auto cells = surround_of(three).cells();
  const auto place = [&](int column) {
    return std::find_if(cells.begin(), cells.end(), [&](const auto& c) { return c[0] == 9 + 1 + column; });
  };
  EXPECT_LT(place(4), place(2)) << "ground before body";
  EXPECT_LT(place(2), place(0)) << "body before head";
}

TEST(Surround, PlaceIsTheCellThatHoldsThePoint) {
  const Surround surround = even_cells();
  const Surround::Place p = surround.place({70 * 64 + kInset, 40 * 64 + kInset});
  const int corner = (1 + 1) * 8 + 2 + 1;
  EXPECT_EQ(p.corner, (std::array{corner, corner + 1, corner + 8, corner + 9}));
  EXPECT_EQ(p.across, 6 * 256 / 32);
  EXPECT_EQ(p.down, 8 * 256 / 32);
  const Surround::Place outside = surround.place({-900, 500 * 64});
  EXPECT_EQ(outside.corner[0], (3 + 1) * 8 + 1) << "the nearest cell of the picture";
  EXPECT_EQ(outside.across, 0);
  EXPECT_EQ(outside.down, 256);
  EXPECT_EQ(outside.rest, glm::ivec2(-900, 500 * 64));
}

TEST(Surround, PlacesAreCarriedByTheirCorners) {
  std::mt19937 random(6);
  const Surround surround = even_cells();
  const auto seen = projected(surround, toy_state());
  auto moved = seen;
  for (glm::ivec2& p : moved) p += glm::ivec2(random() % 3000, random() % 3000) - 1500;
  for (int r = 0; r <= 4; ++r) {
    for (int c = 0; c <= 5; ++c) {
      const auto k = static_cast<std::size_t>((r + 1) * 8 + c + 1);
      EXPECT_EQ(surround.carried(surround.place(seen[k]), moved), moved[k]) << "at a point as the point";
    }
  }
  for (int i = 0; i < 300; ++i) {
    const glm::ivec2 at(static_cast<int>(random() % (kWidth * 64)),
                        static_cast<int>(random() % (kHeight * 64)));
    const double x = at.x % 2048 / 2048.0, y = at.y % 2048 / 2048.0;
    const glm::ivec2 place = at + kInset;
    const auto k = static_cast<std::size_t>((at.y / 2048 + 1) * 8 + at.x / 2048 + 1);
    const auto displacement = [&](std::size_t j) { return glm::dvec2(moved[j] - seen[j]); };
    const glm::dvec2 expected = glm::dvec2(place) +
                                (displacement(k) * (1 - x) + displacement(k + 1) * x) * (1 - y) +
                                (displacement(k + 8) * (1 - x) + displacement(k + 9) * x) * y;
    const glm::ivec2 got = surround.carried(surround.place(place), moved);
    EXPECT_NEAR(got.x, expected.x, 1 + 2 * 3000 / 256.0);  // the place is in 1/256 cell
    EXPECT_NEAR(got.y, expected.y, 1 + 2 * 3000 / 256.0);
  }
}

}  // namespace
}  // namespace fbs
