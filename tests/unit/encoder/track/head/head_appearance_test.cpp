#include "encoder/track/head/head_appearance.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "encoder/find/landmarks.h"
#include "tests/unit/encoder/track/head/head_case.h"

namespace fbs {
namespace {

TEST(HeadAppearance, IsItselfInTheFirstPicture) {
  HeadCase c;
  const LevelledFrame first(c.frame(0));
  EXPECT_GT(c.appearance.correlation(first, c.head.pose, c.points), 0.999);
}

TEST(HeadAppearance, CorrelationFallsAwayFromThePose) {
  HeadCase c;
  const LevelledFrame first(c.frame(0));
  double before = 1;
  for (const double aside : {0.02, 0.05, 0.1}) {
    Pose pose = c.head.pose;
    pose.shift.x += aside * pose.eye_distance_px();
    const double now = c.appearance.correlation(first, pose, c.points);
    EXPECT_LT(now, before) << aside;
    before = now;
  }
  EXPECT_LT(before, 0.8);
}

TEST(HeadAppearance, NothingIsSeenOutsideThePicture) {
  HeadCase c;
  Pose pose = c.head.pose;
  pose.shift.x += 1000;
  EXPECT_EQ(c.appearance.correlation(LevelledFrame(c.frame(0)), pose, c.points), 0);
}

TEST(HeadAppearance, WhatMovesByItselfWeighsLess) {
  HeadCase c;
  const auto points = c.appearance.points();
  const auto weights = c.appearance.weights();
  ASSERT_EQ(points.size(), weights.size());
  int lips = 0, others = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const bool on_lip = std::any_of(points[k].corner.begin(), points[k].corner.end(), [](std::uint16_t v) {
      return generic_head().vertices[v].landmark >= ibug::kMouthFirst;
    });
    lips += on_lip ? 1 : 0;
    others += weights[k] == 1 ? 1 : 0;
    if (on_lip) {
      EXPECT_LT(weights[k], 1);
    }
  }
  EXPECT_GT(lips, 20);
  EXPECT_GT(others, 100);
}

}  // namespace
}  // namespace fbs
