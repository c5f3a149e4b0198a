#include "encoder/find/elastic_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "encoder/find/landmarks.h"

namespace fbs {
namespace {

FrontPoints generic_points() {
  FrontPoints out;
  for (std::size_t v = 0; v < kVertexCount; ++v) out[v] = glm::dvec2(generic_vertex(v));
  return out;
}

TEST(ElasticFit, RestsAtOnceWhereMarksAgree) {
  const FrontPoints points = generic_points();
  FrontMarks marks;
  for (std::size_t v = 0; v < kVertexCount; v += 3) marks[v] = points[v];
  const ElasticFit fit = fit_elastically(points, marks);
  EXPECT_EQ(fit.iterations, 0);
  EXPECT_EQ(fit.points, points);
  EXPECT_EQ(fit_elastically(points, {}).points, points) << "without marks nothing moves";
}

TEST(ElasticFit, ReachesAMarkAndItsNeighbourhoodFollows) {
  const FrontPoints points = generic_points();
  const std::size_t chin = vertex_of_landmark(ibug::kChin), beside = vertex_of_landmark(ibug::kChin + 1),
                    brow = vertex_of_landmark(ibug::kBrowLeft);
  FrontMarks marks;
  marks[chin] = points[chin] + glm::dvec2(0, 0.1);
  marks[brow] = points[brow];
  const ElasticFit fit = fit_elastically(points, marks);
  EXPECT_NEAR(fit.points[chin].y, points[chin].y + 0.1, 1.0 / 256);
  EXPECT_GT(fit.points[beside].y, points[beside].y + 0.02);
  EXPECT_NEAR(fit.points[brow].y, points[brow].y, 1.0 / 256);
}

TEST(ElasticFit, FoldsNoTriangle) {
  const FrontPoints points = generic_points();
  FrontMarks marks;
  marks[vertex_of_landmark(ibug::kNoseTip)] = glm::dvec2(3, -4);
  const FrontPoints fitted = fit_elastically(points, marks).points;
  for (const HeadTriangle& t : generic_head().triangles) {
    const glm::dvec2 a = fitted[t[1]] - fitted[t[0]], b = fitted[t[2]] - fitted[t[0]];
    const glm::dvec2 c = points[t[1]] - points[t[0]], d = points[t[2]] - points[t[0]];
    if (c.x * d.y - c.y * d.x > 0) {
      EXPECT_GT(a.x * b.y - a.y * b.x, 0);
    }
  }
}

}  // namespace
}  // namespace fbs
