#include "cli/video/orientation.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace fbs {
namespace {

// A stored picture 64 wide and 66 high with one bright pixel at the top left.
TEST(Orientation, QuarterTurnsMoveTheTopLeftCorner) {
  constexpr std::int32_t kOne = 1 << 16;
  Picture stored(64, 66);
  stored.y.row(0)[0] = 200;
  stored.u.row(0)[0] = 20;
  const auto shown = [&](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
    return oriented(stored, orientation_from_matrix({a, b, 0, c, d, 0, 0, 0, 1 << 30}));
  };
  EXPECT_EQ(shown(kOne, 0, 0, kOne), stored);
  const Picture clockwise = shown(0, kOne, -kOne, 0);
  EXPECT_EQ(clockwise.width(), 66);
  EXPECT_EQ(clockwise.height(), 64);
  EXPECT_EQ(clockwise.y.row(0)[65], 200);
  EXPECT_EQ(clockwise.u.row(0)[32], 20);
  const Picture anticlockwise = shown(0, -kOne, kOne, 0);
  EXPECT_EQ(anticlockwise.y.row(63)[0], 200);
  const Picture upside_down = shown(-kOne, 0, 0, -kOne);
  EXPECT_EQ(upside_down.y.row(65)[63], 200);
  EXPECT_EQ(oriented(stored, orientation_of_turn(0)), stored);
  EXPECT_EQ(oriented(stored, orientation_of_turn(90)), clockwise);
  EXPECT_EQ(oriented(stored, orientation_of_turn(180)), upside_down);
  EXPECT_EQ(oriented(stored, orientation_of_turn(270)), anticlockwise);
  const Picture mirrored = shown(-kOne, 0, 0, kOne);
  EXPECT_EQ(mirrored.y.row(0)[63], 200);
}

}  // namespace
}  // namespace fbs
