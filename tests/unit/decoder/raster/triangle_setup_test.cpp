#include "decoder/raster/triangle_setup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
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

TEST(TriangleSetup, BoxHasTheSamplesWhoseCentresItReaches) {
  const TriangleSetup luma(triangle({0, 32}, {640, 40}, {0, 64 * 5 + 31}), PlaneScale::kLuma);
  EXPECT_EQ(luma.box().y0, 0);
  EXPECT_EQ(luma.box().y1, 5);
  EXPECT_EQ(luma.box().x0, -1) << "one too many does not harm";
  EXPECT_EQ(luma.box().x1, 10);
  const TriangleSetup chroma(triangle({0, 65}, {640, 70}, {0, 128 * 5 + 64}), PlaneScale::kChroma);
  EXPECT_EQ(chroma.box().y0, 0) << "one too many does not harm";
  EXPECT_EQ(chroma.box().y1, 6);
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
    const int bits = static_cast<int>(scale);
    const Gradient g = setup.gradient(value, 6);
    EXPECT_TRUE(g.exact());
    for (int k = 0; k < 10; ++k) {
      const int column = static_cast<int>(random() % 60), row = static_cast<int>(random() % 60);
      const int64_t px = (column << bits) + (1 << (bits - 1)) - t[0].at.x,
                    py = (row << bits) + (1 << (bits - 1)) - t[0].at.y;
      EXPECT_EQ(g.at(column, row), (int64_t{value[0]} << 10) + ((g.dx * px + g.dy * py) >> bits)) << "SPEC";
      const auto x = static_cast<double>(px), y = static_cast<double>(py);
      const double wb = (x * by - y * bx) / area, wc = (ax * y - ay * x) / area;
      const double expected = value[0] * (1 - wb - wc) + value[1] * wb + value[2] * wc;
      ASSERT_NEAR(static_cast<double>(g.at(column, row)) / (1 << 16), expected / 64, 0.01) << i;
      ++compared;
    }
  }
  EXPECT_GT(compared, 5000);
}

TEST(TriangleSetup, BoxIsWithinTheArea) {
  const auto t = triangle({-640, -640}, {6400, -640}, {-640, 6400});
  const SampleArea box = TriangleSetup(t, PlaneScale::kLuma, {2, 3, 20, 15}).box();
  EXPECT_EQ((std::array{box.x0, box.y0, box.x1, box.y1}), (std::array{2, 3, 20, 15}));
  EXPECT_TRUE(TriangleSetup(t, PlaneScale::kLuma, {200, 3, 220, 15}).box().empty());
}

TEST(Gradient, RangeHoldsAllValuesOfAnArea) {
  std::mt19937 random(3);
  for (int i = 0; i < 1000; ++i) {
    const auto some = [&](int reach) {
      return static_cast<int>(random() % static_cast<unsigned>(2 * reach)) - reach;
    };
    const Gradient g{some(1000), some(100), some(100)};
    const SampleArea area{some(20), some(20), 20 + some(10), 20 + some(10)};
    if (area.empty()) continue;
    const auto [low, high] = g.range(area);
    int64_t least = std::numeric_limits<int64_t>::max(), most = std::numeric_limits<int64_t>::min();
    for (int y = area.y0; y < area.y1; ++y)
      for (int x = area.x0; x < area.x1; ++x) {
        least = std::min(least, g.at(x, y));
        most = std::max(most, g.at(x, y));
      }
    ASSERT_EQ(low, least) << i;
    ASSERT_EQ(high, most) << i;
  }
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
