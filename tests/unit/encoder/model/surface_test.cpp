#include "encoder/model/surface.h"

#include <gtest/gtest.h>

#include <map>

#include "decoder/head/head_deformation.h"
#include "decoder/head/mouth_interior.h"
#include "encoder/model/placed_head.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

PlacedHead head() {
  return {toy_geometry(), fit_of(toy_state())};
}

TEST(Surface, PointsOfATriangleMeanItsCentre) {
  const HeadVertices vertices = head().vertices;
  std::map<int, std::pair<glm::dvec3, int>> sums;
  for (const SurfacePoint& p : spread_over_mesh(vertices, head().projection, 2.5)) {
    EXPECT_NEAR(p.barycentric[0] + p.barycentric[1] + p.barycentric[2], 1, 1e-6);
    EXPECT_EQ(p.corner, generic_head().triangles[p.triangle]);
    auto& [sum, count] = sums[p.triangle];
    sum += p.on(vertices);
    ++count;
  }
  EXPECT_EQ(sums.size(), generic_head().triangles.size()) << "each has one at least";
  for (const auto& [triangle, sum] : sums) {
    const HeadTriangle& t = generic_head().triangles[triangle];
    const glm::dvec3 centre = (vertices[t[0]] + vertices[t[1]] + vertices[t[2]]) / 3.0;
    const glm::dvec3 off = sum.first / static_cast<double>(sum.second) - centre;
    EXPECT_LT(std::hypot(off.x, off.y, off.z), 0.01 * kUnitsPerEyeDistance) << triangle;
  }
}

TEST(Surface, HalfTheSpacingMakesFourTimesThePoints) {
  const auto count = [](double spacing) {
    return static_cast<double>(spread_over_mesh(head().vertices, head().projection, spacing).size());
  };
  EXPECT_NEAR(count(0.5) / count(1), 4, 0.4);
}

TEST(Surface, ClosedMouthHasItsRows) {
  std::map<int, int> counts;
  for (const SurfacePoint& p : spread_over_mesh(head().vertices, head().projection, 100, 5))
    ++counts[p.triangle];
  for (const auto& [triangle, count] : counts) {
    const HeadTriangle& t = generic_head().triangles[triangle];
    const bool mouth = is_mouth(generic_head(), t);
    EXPECT_EQ(count, mouth ? 5 * (5 + 1) / 2 : 1) << triangle;
  }
}

}  // namespace
}  // namespace fbs
