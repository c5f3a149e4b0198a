#include "encoder/find/elastic_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "encoder/find/edge_distances.h"
#include "encoder/find/landmarks.h"

namespace fbs {
namespace {

FrontPoints generic_points() {
  FrontPoints out(kVertexCount);
  for (std::size_t v = 0; v < kVertexCount; ++v) out[v] = glm::dvec2(generic_vertex(v));
  return out;
}

TEST(ElasticFit, RestsAtOnceWhereMarksAgree) {
  const FrontPoints points = generic_points();
  FrontMarks marks(kVertexCount);
  for (std::size_t v = 0; v < kVertexCount; v += 3) marks[v] = points[v];
  const ElasticFit fit = fit_elastically(generic_head(), edge_distances(generic_head()), points, marks);
  EXPECT_EQ(fit.iterations, 0);
  EXPECT_EQ(fit.points, points);
  EXPECT_EQ(fit_elastically(generic_head(), edge_distances(generic_head()), points, FrontMarks(kVertexCount))
                .points,
            points)
      << "without marks nothing moves";
}

TEST(ElasticFit, ReachesAMarkAndItsNeighbourhoodFollows) {
  const FrontPoints points = generic_points();
  const std::size_t chin = vertex_of_landmark(ibug::kChin), beside = vertex_of_landmark(ibug::kChin + 1),
                    brow = vertex_of_landmark(ibug::kBrowLeft);
  FrontMarks marks(kVertexCount);
  marks[chin] = points[chin] + glm::dvec2(0, 0.1);
  marks[brow] = points[brow];
  const ElasticFit fit = fit_elastically(generic_head(), edge_distances(generic_head()), points, marks);
  EXPECT_NEAR(fit.points[chin].y, points[chin].y + 0.1, 1.0 / 256);
  EXPECT_GT(fit.points[beside].y, points[beside].y + 0.02);
  EXPECT_NEAR(fit.points[brow].y, points[brow].y, 1.0 / 256);
}

TEST(ElasticFit, FoldsNoTriangle) {
  const FrontPoints points = generic_points();
  FrontMarks marks(kVertexCount);
  marks[vertex_of_landmark(ibug::kNoseTip)] = glm::dvec2(3, -4);
  const FrontPoints fitted =
      fit_elastically(generic_head(), edge_distances(generic_head()), points, marks).points;
  for (const HeadTriangle& t : generic_head().triangles) {
    const glm::dvec2 a = fitted[t[1]] - fitted[t[0]], b = fitted[t[2]] - fitted[t[0]];
    const glm::dvec2 c = points[t[1]] - points[t[0]], d = points[t[2]] - points[t[0]];
    if (c.x * d.y - c.y * d.x > 0) {
      EXPECT_GT(a.x * b.y - a.y * b.x, 0);
    }
  }
}

TEST(ElasticFit, DepthReachesAMarkAndItsNeighbourhoodFollows) {
  Depths depths(kVertexCount);
  for (std::size_t v = 0; v < depths.size(); ++v) depths[v] = generic_vertex(v).z;
  const std::size_t nose = vertex_of_landmark(ibug::kNoseTip),
                    beside = vertex_of_landmark(ibug::kNoseTip + 3), jaw = vertex_of_landmark(0);
  DepthMarks marks(kVertexCount);
  marks[nose] = depths[nose] - 0.1;
  const Depths fitted = fit_elastically(edge_distances(generic_head()), depths, marks);
  EXPECT_NEAR(fitted[nose], depths[nose] - 0.1, 1.0 / 256);
  EXPECT_LT(fitted[beside], depths[beside] - 0.02);
  EXPECT_NEAR(fitted[jaw], depths[jaw], 0.02);
}

}  // namespace
}  // namespace fbs
