#include "encoder/retarget/head_surround.h"

#include <gtest/gtest.h>

#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr int kCells = 8;

/// All of the ground.
SurroundMap ground() {
  SurroundMap map;
  map.columns = map.rows = kCells;
  map.head.assign((kCells + 1) * (kCells + 1), 0);
  map.body = map.head;
  return map;
}

VideoFormat square() {
  VideoFormat format;
  format.width = format.height = 160;
  return format;
}

/// A head in the middle of the picture, eyes 32 pixels apart.
State middle() {
  State state;
  state.pose = {0, 0, 0, 80 * 64, 80 * 64, 5 * 4096};
  return state;
}

std::size_t point(int column, int row) {
  return static_cast<std::size_t>(row * (kCells + 1) + column);
}

TEST(HeadSurround, HairGoesWithTheHeadAndTheRestDoesNot) {
  const SurroundMap map = with_hair(ground(), square(), middle());
  EXPECT_EQ(map.head[point(4, 4)], kFollowOne) << "the face";
  EXPECT_EQ(map.head[point(4, 2)], kFollowOne) << "above the forehead";
  EXPECT_EQ(map.head[point(0, 0)], 0) << "a corner of the picture";
  EXPECT_EQ(map.head[point(8, 4)], 0) << "far beside it";
}

TEST(HeadSurround, WhatIsKnownToGoWithTheHeadStays) {
  SurroundMap known = ground();
  known.head[point(8, 4)] = 3;
  known.body[point(4, 4)] = known.body[point(0, 8)] = 2;
  const SurroundMap map = with_hair(known, square(), middle());
  EXPECT_EQ(map.head[point(8, 4)], 3);
  EXPECT_EQ(map.body[point(0, 8)], 2);
  EXPECT_EQ(map.body[point(4, 4)], 0) << "what goes wholly with the head has no rest";
}

}  // namespace
}  // namespace fbs
