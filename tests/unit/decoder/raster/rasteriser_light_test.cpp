// Textures under a light.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "decoder/raster/rasteriser.h"
#include "tests/unit/decoder/raster/textured_triangle.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr int kWidth = 24, kHeight = 20;

/// Draws a pattern in its place under a light, over the lower left half of the picture.
Plane lit(const Plane& pattern, const Light& light) {
  Plane target(pattern.width, pattern.height);
  const int right = 64 * pattern.width, bottom = 64 * pattern.height;
  const std::array<glm::ivec2, 3> p = {glm::ivec2(0, 0), {right, bottom}, {0, bottom}};
  draw(in_place(p[0], p[1], p[2]), PlaneScale::kLuma, pattern, target, light, LightUse::kAdded);
  return target;
}

Light even(std::int32_t offset, std::int32_t gain) {
  return {{offset, offset, offset}, {gain, gain, gain}};
}

TEST(RasteriserLight, NoneLeavesThePatternAsItIs) {
  const Plane pattern = noise_plane(kWidth, kHeight, 1);
  const Plane out = lit(pattern, Light{});
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < y; ++x) ASSERT_EQ(out.row(y)[x], pattern.row(y)[x]);
}

// 1/16 grey level, rounded to nearest with halves up.
TEST(RasteriserLight, OffsetIsAddedInSixteenthsAndRounded) {
  const Plane grey(kWidth, kHeight, 100);
  const auto at = [&](std::int32_t offset) { return lit(grey, even(offset, 0)).row(15)[3]; };
  EXPECT_EQ(at(16), 101);
  EXPECT_EQ(at(7), 100);
  EXPECT_EQ(at(8), 101);
  EXPECT_EQ(at(-8), 100);
  EXPECT_EQ(at(-9), 99);
  EXPECT_EQ(at(16 * 200), 255);
  EXPECT_EQ(at(-16 * 200), 0);
}

TEST(RasteriserLight, GainIsAboutTheMiddleGrey) {
  const auto at = [](std::uint8_t grey, std::int32_t gain) {
    return lit(Plane(kWidth, kHeight, grey), even(0, gain)).row(15)[3];
  };
  EXPECT_EQ(at(128, 4000), 128);
  EXPECT_EQ(at(192, 16 * 20), 212) << "64 levels above 128: the gain itself";
  EXPECT_EQ(at(64, 16 * 20), 44);
  EXPECT_EQ(at(160, -16 * 20), 150);
  EXPECT_EQ(at(96, -16 * 20), 106);
  EXPECT_EQ(at(128 + 32, 16), 161) << "half a level goes up";
  EXPECT_EQ(at(250, 16 * 64), 255);
  EXPECT_EQ(at(5, 16 * 64), 0);
}

TEST(RasteriserLight, IsLinearOverTheTriangle) {
  const Plane pattern = smooth_plane(kWidth, kHeight, 3);
  const Light light{{400, -320, 160}, {-200, 300, 640}};
  const Plane out = lit(pattern, light);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double across = (x + 0.5) / kWidth, down = (y + 0.5) / kHeight;
      if (across > down - 0.01) continue;
      const auto over = [&](const std::array<std::int32_t, 3>& c) {
        return c[0] * (1 - down) + c[1] * across + c[2] * (down - across);
      };
      const double value = pattern.row(y)[x];
      const double expected = value + (over(light.offset) + over(light.gain) * (value - 128) / 64) / 16;
      ASSERT_NEAR(out.row(y)[x], std::clamp(expected, 0.0, 255.0), 0.51) << x << ' ' << y;
    }
  }
}

/// A triangle a unit or two wide and as long as the screen allows, about a sample's centre.
TexturedTriangle sliver(std::mt19937& random) {
  const auto within = [&](int n) {
    return static_cast<int>(random() % static_cast<unsigned>(2 * n + 1)) - n;
  };
  const glm::ivec2 centre(static_cast<int>(random() % 32) * 64 + 32,
                          static_cast<int>(random() % 24) * 64 + 32);
  const glm::ivec2 along(within(1 << 20), within(1 << 20)), side(within(2), within(2));
  return {{{centre - along, {}, 0}, {centre + along + side, {}, 0}, {centre + along - side, {}, 0}}};
}

/// SPEC 10.7 with n = 22 and o = 16, clamped: what light adds at the centre of a sample, 2^-20 grey level.
std::int64_t plain_light(const TexturedTriangle& t, const std::array<std::int32_t, 3>& v, int x, int y) {
  using std::int64_t;
  const int64_t ax = t[1].screen.x - t[0].screen.x, ay = t[1].screen.y - t[0].screen.y;
  const int64_t bx = t[2].screen.x - t[0].screen.x, by = t[2].screen.y - t[0].screen.y;
  const int64_t area = ax * by - ay * bx, limit = int64_t{1} << 30;
  const int64_t va = v[1] - v[0], vb = v[2] - v[0];
  const int64_t gx = std::clamp(((va * by - vb * ay) << 22) / area, -limit, limit),
                gy = std::clamp(((vb * ax - va * bx) << 22) / area, -limit, limit);
  const int64_t dx = 64 * x + 32 - t[0].screen.x, dy = 64 * y + 32 - t[0].screen.y;
  const int64_t at = (int64_t{v[0]} << 16) + ((gx * dx + gy * dy) >> 6);
  return std::clamp<int64_t>(at, -(kMaxLight << 16), kMaxLight << 16);
}

// Corners as far away and lights as strong as a stream can have them: nothing overflows (sanitizers).
TEST(RasteriserLight, IsThatOfThePlainRuleOnHostileTriangles) {
  std::mt19937 random(5);
  int drawn = 0;
  for (int i = 0; i < 30000; ++i) {
    const TexturedTriangle t = sliver(random);
    const Plane pattern(32, 24, static_cast<std::uint8_t>(random()));
    Light light;
    for (auto* corners : {&light.offset, &light.gain})
      for (std::int32_t& c : *corners)
        c = random() % 2 == 0 ? static_cast<int>(random() % 400) : random() % 2 == 0 ? kMaxLight : -kMaxLight;
    Plane target(32, 24, 77);
    const DepthPlane depth = draw(t, PlaneScale::kLuma, pattern, target, light, LightUse::kAdded);
    for (int y = 0; y < 24; ++y) {
      for (int x = 0; x < 32; ++x) {
        if (depth.depth[y * 32 + x] != 0) continue;
        ++drawn;
        const std::int64_t grey = pattern.samples[0];
        const std::int64_t sum = (grey << 12) + (plain_light(t, light.offset, x, y) >> 8) +
                                 ((grey - 128) * (plain_light(t, light.gain, x, y) >> 8) >> 6);
        ASSERT_EQ(target.row(y)[x], std::clamp<std::int64_t>((sum + 2048) >> 12, 0, 255)) << i;
      }
    }
  }
  EXPECT_GT(drawn, 10000);
}

}  // namespace
}  // namespace fbs
