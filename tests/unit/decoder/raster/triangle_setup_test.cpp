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

bool inside(const Edge& e, int column, int row) {
  return e.a * column + e.b * row + e.c >= 0;
}

// A square of 10 x 10 luma samples whose edges pass through centres of samples.
TEST(Edge, TopAndLeftEdgesBelongToTheTriangle) {
  const auto at = [](int x, int y) { return glm::ivec2(64 * x + 32, 64 * y + 32); };
  const Edge top(at(0, 0), at(10, 0), 6), right(at(10, 0), at(10, 10), 6), bottom(at(10, 10), at(0, 10), 6),
      left(at(0, 10), at(0, 0), 6);
  EXPECT_TRUE(inside(top, 5, 0) && !inside(top, 5, -1));
  EXPECT_TRUE(inside(left, 0, 5) && !inside(left, -1, 5));
  EXPECT_TRUE(inside(right, 9, 5) && !inside(right, 10, 5));
  EXPECT_TRUE(inside(bottom, 5, 9) && !inside(bottom, 5, 10));
}

// SPEC 10.6 at the centre of each sample, luma and chroma.
TEST(Edge, IsTheFormatsHalfPlane) {
  std::mt19937 random(2);
  for (int i = 0; i < 20000; ++i) {
    const auto p = [&] {
      return glm::ivec2(random() % 2048, random() % 2048) / (i % 2 == 0 ? 1 : 32) * (i % 2 == 0 ? 1 : 32);
    };
    const glm::ivec2 from = p(), to = p();
    const int bits = i % 3 == 0 ? 7 : 6;
    const int column = static_cast<int>(random() % 16), row = static_cast<int>(random() % 16);
    const int64_t x = (column << bits) + (1 << (bits - 1)), y = (row << bits) + (1 << (bits - 1));
    const int64_t m = (int64_t{from.y} - to.y) * (x - from.x) + (int64_t{to.x} - from.x) * (y - from.y);
    const bool belongs = to.y < from.y || (to.y == from.y && to.x > from.x);
    ASSERT_EQ(inside(Edge(from, to, bits), column, row), m > 0 || (m == 0 && belongs)) << i;
  }
}

}  // namespace
}  // namespace fbs
