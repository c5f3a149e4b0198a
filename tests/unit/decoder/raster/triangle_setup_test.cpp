#include "decoder/raster/triangle_setup.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

namespace fbs {
namespace {

using std::int64_t;

ScreenTriangle triangle(glm::ivec2 a, glm::ivec2 b, glm::ivec2 c) {
  return {{{a}, {b}, {c}}};
}

ScreenTriangle random_triangle(std::mt19937& random, int reach) {
  const auto p = [&] {
    const auto within = [&] { return static_cast<int>(random() % static_cast<unsigned>(2 * reach)) - reach; };
    return glm::ivec2(within(), within());
  };
  return triangle(p(), p(), p());
}

TEST(TriangleSetup, FacesTheViewerWhenClockwise) {
  const auto clockwise = triangle({0, 0}, {640, 0}, {0, 640}), other = triangle({0, 0}, {0, 640}, {640, 0});
  EXPECT_TRUE(TriangleSetup(clockwise, PlaneScale::kLuma).faces_viewer());
  EXPECT_FALSE(TriangleSetup(other, PlaneScale::kLuma).faces_viewer());
  EXPECT_FALSE(TriangleSetup(triangle({0, 0}, {64, 64}, {128, 128}), PlaneScale::kLuma).faces_viewer());
  EXPECT_TRUE(faces_viewer(clockwise));
  EXPECT_FALSE(faces_viewer(other));
}

TEST(TriangleSetup, RowsAreThoseWhoseCentresItReaches) {
  const TriangleSetup luma(triangle({0, 32}, {640, 40}, {0, 64 * 5 + 31}), PlaneScale::kLuma);
  EXPECT_EQ(luma.first_row(), 0);
  EXPECT_EQ(luma.last_row(), 4);
  const TriangleSetup chroma(triangle({0, 65}, {640, 70}, {0, 128 * 5 + 64}), PlaneScale::kChroma);
  EXPECT_EQ(chroma.first_row(), 0) << "one too many does not harm";
  EXPECT_EQ(chroma.last_row(), 5);
}

// SPEC 10.7, at each corner and in between.
TEST(TriangleSetup, GradientIsThePlaneThroughTheCorners) {
  std::mt19937 random(1);
  int compared = 0;
  for (int i = 0; i < 2000; ++i) {
    const ScreenTriangle t = random_triangle(random, 4000);
    const PlaneScale scale = i % 2 == 0 ? PlaneScale::kLuma : PlaneScale::kChroma;
    const TriangleSetup setup(t, scale);
    const double ax = t[1].at.x - t[0].at.x, ay = t[1].at.y - t[0].at.y, bx = t[2].at.x - t[0].at.x,
                 by = t[2].at.y - t[0].at.y, area = ax * by - ay * bx;
    if (area < 1e5) continue;
    const std::array<std::int32_t, 3> value = {static_cast<int>(random() % 8000),
                                               static_cast<int>(random() % 8000),
                                               static_cast<int>(random() % 8000)};
    const int bits = setup.position_bits();
    const Gradient g = setup.gradient(value, 6);
    EXPECT_TRUE(g.exact());
    for (int k = 0; k < 10; ++k) {
      const int column = static_cast<int>(random() % 60), row = static_cast<int>(random() % 60);
      const FromCorner p = setup.from_corner(column, row);
      EXPECT_EQ(p.x, (column << bits) + (1 << (bits - 1)) - t[0].at.x);
      const auto x = static_cast<double>(p.x), y = static_cast<double>(p.y);
      const double wb = (x * by - y * bx) / area, wc = (ax * y - ay * x) / area;
      const double expected = value[0] * (1 - wb - wc) + value[1] * wb + value[2] * wc;
      ASSERT_NEAR(static_cast<double>(g.at(p, bits)) / (1 << 16), expected / 64, 0.01) << i;
      ++compared;
    }
  }
  EXPECT_GT(compared, 5000);
}

TEST(TriangleSetup, GradientsOfSliversAreClamped) {
  const TriangleSetup sliver(triangle({0, 0}, {1, 0}, {1, 1 << 20}), PlaneScale::kLuma);
  ASSERT_TRUE(sliver.faces_viewer());
  const Gradient g = sliver.gradient({0, 1 << 20, 0}, 6);
  EXPECT_EQ(std::abs(g.dx), kMaxGradient);
  EXPECT_FALSE(g.exact());
}

// a x + b y + c >= 0 holds left and above, not right and below.
TEST(Edge, TopAndLeftEdgesBelongToTheTriangle) {
  const auto on = [](const Edge& e, int64_t x, int64_t y) { return e.a * x + e.b * y + e.c >= 0; };
  const Edge top({0, 0}, {100, 0}), right({100, 0}, {100, 100}), bottom({100, 100}, {0, 100}),
      left({0, 100}, {0, 0});
  EXPECT_TRUE(on(top, 50, 0) && on(top, 50, 1) && !on(top, 50, -1));
  EXPECT_TRUE(on(left, 0, 50) && on(left, 1, 50) && !on(left, -1, 50));
  EXPECT_TRUE(!on(right, 100, 50) && on(right, 99, 50));
  EXPECT_TRUE(!on(bottom, 50, 100) && on(bottom, 50, 99));
}

}  // namespace
}  // namespace fbs
