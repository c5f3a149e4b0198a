#include "encoder/model/pose_jacobian.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fbs {
namespace {

TEST(PoseJacobian, PredictsHowAPointMoves) {
  const Pose pose{0.1, -0.2, 0.05, {80, 60}, 5};
  const glm::dvec3 p(1500, -900, -700);
  constexpr double kStep = 1e-3;
  const auto by = PoseJacobian(pose).at(p);
  for (int k = 0; k < 6; ++k) {
    PoseStep up, down;
    up[k] = kStep;
    down[k] = -kStep;
    const glm::dvec2 slope =
        (PoseProjection(moved(pose, up))(p) - PoseProjection(moved(pose, down))(p)) / (2 * kStep);
    EXPECT_NEAR(by[static_cast<std::size_t>(k)].x, slope.x, 2e-3) << k;
    EXPECT_NEAR(by[static_cast<std::size_t>(k)].y, slope.y, 2e-3) << k;
  }
}

TEST(PoseJacobian, RotationsStayWithinWhatShowsAFace) {
  PoseStep far;
  far[0] = 3;
  far[1] = -3;
  const Pose pose = moved({}, far);
  EXPECT_EQ(pose.pitch, -pose.yaw);
  EXPECT_LT(pose.pitch, 1.57);
}

}  // namespace
}  // namespace fbs
