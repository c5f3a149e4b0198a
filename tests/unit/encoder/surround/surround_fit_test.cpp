#include "encoder/surround/surround_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "encoder/surround/surround_observations.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr int kWidth = 320, kHeight = 240;

/// A head with hair, an ellipse of its own texture, before a still ground; the head has moved by (dx, dy)
/// pixels.
Picture head_before_ground(int dx, int dy) {
  static const Plane ground = smooth_plane(kWidth, kHeight, 1), head = smooth_plane(kWidth, kHeight, 2);
  Picture out(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double u = (x - dx - 160) / 62.0, v = (y - dy - 118) / 82.0;
      const int hx = std::clamp(x - dx, 0, kWidth - 1), hy = std::clamp(y - dy, 0, kHeight - 1);
      out.y.row(y)[x] = u * u + v * v < 1 ? head.row(hy)[hx] : ground.row(y)[x];
    }
  }
  return out;
}

SurroundMap fitted() {
  Setup setup = toy_setup(kWidth, kHeight);
  State first = toy_state(160, 100);
  first.pose[kLogScale] = static_cast<std::int32_t>(std::lround(4096 * std::log2(40.0)));
  SurroundObservations observations(setup.format);
  observations.set_first(head_before_ground(0, 0), first);
  const std::array<glm::ivec2, 6> moves = {{{8, 0}, {12, 3}, {4, -6}, {-9, 2}, {-12, -4}, {3, 7}}};
  for (const glm::ivec2 m : moves) {
    State s = first;
    s.pose[kShiftX] += m.x * 64;
    s.pose[kShiftY] += m.y * 64;
    observations.add(head_before_ground(m.x, m.y), s);
  }
  return fit_surround(setup, toy_geometry(), observations);
}

TEST(FitSurround, HairFollowsTheHeadAndTheGroundStays) {
  const SurroundMap map = fitted();
  int hair = 0, ground = 0;
  double followed = 0, stayed = 0;
  for (int r = 1; r < map.rows; ++r) {
    for (int c = 1; c < map.columns; ++c) {
      const double x = kWidth * c / static_cast<double>(map.columns),
                   y = kHeight * r / static_cast<double>(map.rows);
      const double distance = std::hypot((x - 160) / 62, (y - 118) / 82);
      const int follow = map.head[r * (map.columns + 1) + c];
      if (distance < 0.75) {
        ++hair;
        followed += follow / static_cast<double>(kFollowOne);
      } else if (distance > 1.45) {
        ++ground;
        stayed += follow == 0 ? 1 : 0;
      }
    }
  }
  ASSERT_GT(hair, 20);
  ASSERT_GT(ground, 60);
  EXPECT_GT(followed / hair, 0.95);
  EXPECT_GT(stayed / ground, 0.95);
}

TEST(FitSurround, BorderAlwaysStays) {
  const SurroundMap map = fitted();
  EXPECT_EQ(map.body.size(), map.head.size());
  ASSERT_EQ(map.head.size(), static_cast<std::size_t>((map.columns + 1) * (map.rows + 1)));
  for (int r = 0; r <= map.rows; ++r)
    for (int c = 0; c <= map.columns; ++c)
      if (r == 0 || c == 0 || r == map.rows || c == map.columns) {
        EXPECT_EQ(map.head[r * (map.columns + 1) + c], 0);
      }
}

// A clip of one picture: nothing tells, so distance from the face decides.
TEST(FitSurround, GuessesByDistanceWithoutLaterPictures) {
  State first = toy_state(160, 100);
  const fbs::Setup setup = toy_setup(kWidth, kHeight);
  SurroundObservations observations(setup.format);
  observations.set_first(head_before_ground(0, 0), first);
  const SurroundMap map = fit_surround(setup, toy_geometry(), observations);
  const auto at = [&](double x, double y) {
    const int c = static_cast<int>(std::lround(x * map.columns / kWidth)),
              r = static_cast<int>(std::lround(y * map.rows / kHeight));
    return map.head[r * (map.columns + 1) + c];
  };
  EXPECT_EQ(at(160, 105), kFollowOne);
  EXPECT_EQ(at(20, 20), 0);
  EXPECT_EQ(at(300, 220), 0);
}

}  // namespace
}  // namespace fbs
