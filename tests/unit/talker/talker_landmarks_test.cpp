#include <gtest/gtest.h>

#include <cmath>

#include "tests/talker/talker_head.h"

namespace fbs::talker {
namespace {

TEST(TalkerLandmarks, LandmarksLieOnTheMovedSurface) {
  Expression e = neutral();
  e.mouth_open = 0.25f;
  e.mouth_wide = -0.08f;
  e.mouth_round = 0.08f;
  e.brow_left = 0.1f;
  const auto points = landmarks(e);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(skull_distance(rest_of(points[i], e)), 0, 0.01) << "point " << i;
  }
}

TEST(TalkerLandmarks, ShutLidsMeet) {
  Expression e = neutral();
  e.eye_open_right = 0;
  const auto p = landmarks(e);
  EXPECT_LT(std::abs(p[37].y - p[41].y), 1e-3f);
  EXPECT_GT(p[47].y - p[43].y, 0.1f);
}

}  // namespace
}  // namespace fbs::talker
