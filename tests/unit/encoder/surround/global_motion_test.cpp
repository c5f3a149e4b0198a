#include "encoder/surround/global_motion.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/encoder/moving_pictures.h"

namespace fbs {
namespace {

constexpr int kWidth = 352, kHeight = 288;

/// Displacement of the upper left corner, pixels from the middle.
std::complex<double> corner(const PlaneMotion& m) {
  const std::complex<double> at(-kWidth / 2.0, -kHeight / 2.0);
  return m.turn * at + m.shift - at;
}

PlaneMotion motion_at(int t) {
  return {std::polar(1 + 0.004 * t, 0.003 * t), {2.5 * t, -1.2 * t}};
}

TEST(GlobalMotion, FollowsPanZoomAndRoll) {
  GlobalMotion motion;
  for (int t = 0; t <= 40; ++t) {
    const PlaneMotion truth = motion_at(t);
    const auto seen = motion.observe(seen_wall(kWidth, kHeight, truth.turn, truth.shift));
    EXPECT_LT(std::abs(corner(seen.since_first) - corner(truth)), 1.5) << t;
    if (t > 2) {
      EXPECT_LT(seen.moved, 0.2 * seen.still + 1) << t;
    }
  }
}

TEST(GlobalMotion, FindsASuddenJump) {
  GlobalMotion motion;
  static_cast<void>(motion.observe(seen_wall(kWidth, kHeight, 1, 0)));
  const auto seen = motion.observe(seen_wall(kWidth, kHeight, 1, {22, -14}));
  EXPECT_LT(std::abs(seen.since_first.shift - std::complex<double>(22, -14)), 0.5);
}

TEST(GlobalMotion, RestsBehindWhatMoves) {
  GlobalMotion motion;
  std::mt19937 random(1);
  double moved = 0, still = 0;
  for (int t = 0; t < 30; ++t) {
    Picture p = circling_squares(kWidth, kHeight, t);
    for (auto& s : p.y.samples) s = static_cast<std::uint8_t>(s + random() % 5);
    const auto seen = motion.observe(p);
    EXPECT_LT(std::abs(corner(seen.since_first)), 1) << t;
    moved += seen.moved;
    still += seen.still;
  }
  EXPECT_GT(moved, 0.8 * still);
}

TEST(GlobalMotion, IsHeldOverACut) {
  GlobalMotion motion;
  for (int t = 0; t < 10; ++t) static_cast<void>(motion.observe(seen_wall(kWidth, kHeight, 1, 3.0 * t)));
  motion.cut();
  const auto seen = motion.observe(scenery(kWidth, kHeight));
  EXPECT_LT(std::abs(seen.since_first.shift - 27.0), 1);
  EXPECT_EQ(seen.still, 0);
}

TEST(GlobalMotion, NothingIsSeenInAPlainPicture) {
  GlobalMotion motion;
  Picture grey(kWidth, kHeight);
  for (int t = 0; t < 3; ++t) {
    const auto seen = motion.observe(grey);
    EXPECT_EQ(seen.since_first.shift, 0.0);
    EXPECT_TRUE(seen.places.empty());
  }
}

}  // namespace
}  // namespace fbs
