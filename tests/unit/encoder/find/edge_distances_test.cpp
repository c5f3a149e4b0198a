#include "encoder/find/edge_distances.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/generic_head.h"

namespace fbs {
namespace {

TEST(EdgeDistances, AreAMetricOverTheMesh) {
  const auto d = edge_distances(generic_head());
  const auto at = [&](int a, int b) { return d[a * kVertexCount + b]; };
  ASSERT_EQ(d.size(), static_cast<std::size_t>(kVertexCount * kVertexCount));
  for (int a = 0; a < kVertexCount; ++a) {
    EXPECT_EQ(at(a, a), 0);
    for (int b = 0; b < kVertexCount; ++b) {
      ASSERT_TRUE(std::isfinite(at(a, b)));
      ASSERT_EQ(at(a, b), at(b, a));
      for (int c = 0; c < kVertexCount; c += 7) ASSERT_LE(at(a, b), at(a, c) + at(c, b) + 1e-5F);
    }
  }
}

TEST(EdgeDistances, AreNoShorterThanTheStraightLine) {
  const auto d = edge_distances(generic_head());
  for (std::size_t a = 0; a < kVertexCount; ++a) {
    for (std::size_t b = 0; b < kVertexCount; ++b) {
      const glm::dvec3 e =
          glm::dvec3(generic_head().vertices[a].position - generic_head().vertices[b].position) / 4096.0;
      ASSERT_GE(d[a * kVertexCount + b], std::sqrt(e.x * e.x + e.y * e.y + e.z * e.z) - 1e-4);
    }
  }
}

}  // namespace
}  // namespace fbs
