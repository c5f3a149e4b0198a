#include "tests/figures/wire_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "encoder/model/pose.h"

namespace fbs {
namespace {

std::vector<glm::dvec3> turned_head(double yaw) {
  Pose pose;
  pose.yaw = yaw;
  const PoseProjection projection(pose);
  std::vector<glm::dvec3> out;
  for (const HeadVertex& v : generic_head().vertices) {
    const glm::dvec3 p(v.position);
    out.emplace_back(projection(p), (projection.matrix * p).z);
  }
  return out;
}

double length(const std::vector<LineSegment>& lines) {
  double sum = 0;
  for (const auto& [a, b] : lines) sum += std::hypot(b.x - a.x, b.y - a.y);
  return sum;
}

double length_of_all_edges(const std::vector<glm::dvec3>& head) {
  std::set<std::pair<std::uint16_t, std::uint16_t>> edges;
  for (const HeadTriangle& t : generic_head().triangles)
    for (std::size_t i = 0; i < 3; ++i) edges.insert(std::minmax(t[i], t[(i + 1) % 3]));
  std::vector<LineSegment> lines;
  lines.reserve(edges.size());
  for (const auto& [a, b] : edges) lines.push_back({glm::dvec2(head[a]), glm::dvec2(head[b])});
  return length(lines);
}

TEST(WireFrame, HardlyAnythingIsHiddenFromTheFront) {
  const auto head = turned_head(0);
  EXPECT_GT(length(visible_edges(generic_head(), head)), 0.97 * length_of_all_edges(head));
}

TEST(WireFrame, HalfTheHeadIsHiddenFromTheSide) {
  const auto head = turned_head(1.5);
  const double share = length(visible_edges(generic_head(), head)) / length_of_all_edges(head);
  EXPECT_GT(share, 0.3);
  EXPECT_LT(share, 0.6);
}

TEST(WireFrame, TheFarEyeHidesBehindTheNose) {
  const auto seen = [](double yaw, std::size_t landmark) {
    const auto head = turned_head(yaw);
    const glm::dvec3 p = head[vertex_of_landmark(landmark)];
    return std::ranges::any_of(visible_vertices(generic_head(), head),
                               [&](glm::dvec2 v) { return std::hypot(v.x - p.x, v.y - p.y) < 1e-6; });
  };
  constexpr std::size_t kRightInner = 39, kLeftInner = 42;
  for (const double yaw : {0.0, 1.2}) EXPECT_TRUE(seen(yaw, kLeftInner) || seen(yaw, kRightInner));
  EXPECT_TRUE(seen(0, kRightInner));
  EXPECT_TRUE(seen(0, kLeftInner));
  EXPECT_NE(seen(1.2, kRightInner), seen(1.2, kLeftInner));
}

TEST(WireFrame, NothingIsSeenFromBehind) {
  EXPECT_LT(length(visible_edges(generic_head(), turned_head(3.14159))),
            0.05 * length_of_all_edges(turned_head(0)));
}

}  // namespace
}  // namespace fbs
