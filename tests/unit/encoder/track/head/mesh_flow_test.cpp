#include "encoder/track/head/mesh_flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/unit/encoder/track/head/head_case.h"

namespace fbs {
namespace {

MeshFlow flow_of(const Pose& pose, const HeadVertices& vertices) {
  MeshFlow out;
  for (std::size_t v = 0; v < kVertexCount; ++v) out[v] = PoseProjection(pose)(vertices[v]);
  return out;
}

Pose moved_pose(Pose pose) {
  pose.yaw += 0.1;
  pose.pitch -= 0.05;
  pose.roll += 0.03;
  pose.shift += glm::dvec2(6, -4);
  pose.log2_scale += 0.04;
  return pose;
}

void expect_near(const Pose& found, const Pose& wanted, double tolerance) {
  EXPECT_NEAR(found.yaw, wanted.yaw, tolerance);
  EXPECT_NEAR(found.pitch, wanted.pitch, tolerance);
  EXPECT_NEAR(found.roll, wanted.roll, tolerance);
  EXPECT_NEAR(found.log2_scale, wanted.log2_scale, tolerance);
  EXPECT_LT(shift_between(found, wanted), tolerance);
}

TEST(FitPose, FindsThePoseOfAnExactFlow) {
  HeadCase c(1);
  const Pose wanted = moved_pose(c.head.pose);
  expect_near(fit_pose(flow_of(wanted, c.neutral), c.head.pose, c.neutral), wanted, 0.01);
}

TEST(FitPose, WildAndLostVerticesDoNotMatter) {
  HeadCase c(1);
  const Pose wanted = moved_pose(c.head.pose);
  MeshFlow flow = flow_of(wanted, c.neutral);
  for (std::size_t v = 0; v < kVertexCount; v += 7) flow[v] += glm::dvec2(80, 50);
  for (std::size_t v = 3; v < kVertexCount; v += 7)
    flow[v] = glm::dvec2(std::numeric_limits<double>::quiet_NaN());
  expect_near(fit_pose(flow, c.head.pose, c.neutral), wanted, 0.02);
}

TEST(FitPose, StaysWithoutAnyFlow) {
  HeadCase c(1);
  MeshFlow flow;
  flow.fill(glm::dvec2(std::numeric_limits<double>::quiet_NaN()));
  expect_near(fit_pose(flow, c.head.pose, c.neutral), c.head.pose, 1e-12);
}

TEST(MeshFlow, GoesWithThePicture) {
  HeadCase c(1);
  // The same picture cut elsewhere: nothing moves.
  const WorkFrame first = c.frame(0);
  const WorkFrame again =
      WorkFrame::cut(c.clip[0], c.head.pose.shift + glm::dvec2(8, 4), c.head.pose.eye_distance_px(), false);
  const MeshFlow flow = mesh_flow(first, again, c.head.pose, c.neutral);
  const PoseProjection projection(c.head.pose);
  std::vector<double> away;
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    if (std::isnan(flow[v].x)) continue;
    const glm::dvec2 d = flow[v] - projection(c.neutral[v]);
    away.push_back(std::hypot(d.x, d.y));
  }
  ASSERT_GT(away.size(), 80U);
  std::nth_element(away.begin(), away.begin() + static_cast<std::ptrdiff_t>(away.size() / 2), away.end());
  EXPECT_LT(away[away.size() / 2], 0.3) << "median, pixels";
}

}  // namespace
}  // namespace fbs
