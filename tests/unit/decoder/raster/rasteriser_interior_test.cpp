// draw_triangle with an InteriorMix.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "decoder/raster/rasteriser.h"
#include "tests/unit/decoder/raster/textured_triangle.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr int kWidth = 24, kHeight = 20;

using Colours = std::array<std::uint8_t, kInteriorCount>;

/// InteriorMix without its colours.
struct Mix {
  std::array<std::int32_t, 3> ramp;
  std::int32_t opacity;
};

/// Draws a pattern with colours mixed over it. Samples that were drawn have depth 0.
Plane mixed(const TexturedTriangle& t, PlaneScale scale, const Plane& pattern, const Mix& mix,
            const Colours& colours, DepthPlane& depth) {
  Plane target(pattern.width, pattern.height);
  depth.reset(pattern.width, pattern.height, whole(target));
  const std::array<Colours, 2> both = {colours, colours};
  const InteriorMix interior{mix.ramp, mix.opacity, both};
  draw(t, scale, pattern, target, &depth, {.interior = &interior});
  return target;
}

Plane mixed(const Plane& pattern, const Mix& mix, const Colours& colours) {
  DepthPlane depth;
  return mixed(kLarge, PlaneScale::kLuma, pattern, mix, colours, depth);
}

/// SPEC 10.10: the colour at a place of the ramp.
double plain_colour(const Colours& c, double ramp) {
  return ramp < 128 ? c[0] + (c[1] - c[0]) * ramp / 128 : c[1] + (c[2] - c[1]) * (ramp - 128) / 128;
}

TEST(RasteriserInterior, GoesThroughThreeColours) {
  const Plane pattern = noise_plane(kWidth, kHeight, 1);
  const Colours colours = {40, 200, 120};
  const auto at = [&](std::int32_t ramp) {
    const Plane out = mixed(pattern, {{ramp, ramp, ramp}, 256}, colours);
    EXPECT_EQ(out, Plane(kWidth, kHeight, out.samples[0])) << "the pattern is hidden";
    return out.samples[0];
  };
  EXPECT_EQ(at(0), 40);
  EXPECT_EQ(at(64), 120);
  EXPECT_EQ(at(127), 199) << "198.75";
  EXPECT_EQ(at(128), 200);
  EXPECT_EQ(at(129), 199) << "199.375";
  EXPECT_EQ(at(192), 160);
  EXPECT_EQ(at(256), 120);
}

TEST(RasteriserInterior, RampStaysBetweenItsEnds) {
  const Plane pattern(kWidth, kHeight, 90);
  EXPECT_EQ(mixed(pattern, {{-300, -300, -300}, 256}, {40, 200, 120}), Plane(kWidth, kHeight, 40));
  EXPECT_EQ(mixed(pattern, {{900, 900, 900}, 256}, {40, 200, 120}), Plane(kWidth, kHeight, 120));
}

TEST(RasteriserInterior, NothingOfItIsThePatternAndAllTheColour) {
  const Plane pattern = noise_plane(kWidth, kHeight, 2);
  EXPECT_EQ(mixed(pattern, {{256, 256, 256}, 0}, {1, 50, 99}), pattern);
  EXPECT_EQ(mixed(pattern, {{256, 256, 256}, 256}, {1, 50, 99}), Plane(kWidth, kHeight, 99));
  const Plane half = mixed(pattern, {{256, 256, 256}, 128}, {1, 50, 99});
  for (std::size_t i = 0; i < pattern.samples.size(); ++i)
    ASSERT_EQ(half.samples[i], (pattern.samples[i] + 99 + 1) / 2);
}

TEST(RasteriserInterior, IsARampOverTheTriangle) {
  std::mt19937 random(3);
  const Plane pattern = noise_plane(kWidth, kHeight, 4);
  int compared = 0;
  for (int i = 0; i < 500; ++i) {
    const PlaneScale scale = i % 2 == 0 ? PlaneScale::kLuma : PlaneScale::kChroma;
    const int unit = 1 << static_cast<int>(scale);
    const auto within = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n * unit)); };
    const auto p = [&] {
      return glm::ivec2(within(kWidth + 16) - 8 * unit, within(kHeight + 16) - 8 * unit);
    };
    const TexturedTriangle t = in_place(p(), p(), p());
    const Mix mix{{0, 128, 256}, static_cast<std::int32_t>(random() % 257)};
    const Colours colours = {40, 200, 90};
    DepthPlane depth;
    const Plane out = mixed(t, scale, pattern, mix, colours, depth);
    const glm::dvec2 a(t[0].screen), ab = glm::dvec2(t[1].screen) - a, ac = glm::dvec2(t[2].screen) - a;
    const double area = ab.x * ac.y - ab.y * ac.x;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        if (depth.depth[y * kWidth + x] != 0) continue;
        ++compared;
        const glm::dvec2 d = glm::dvec2((x + 0.5) * unit, (y + 0.5) * unit) - a;
        const double ramp = (128 * (d.x * ac.y - d.y * ac.x) + 256 * (ab.x * d.y - ab.y * d.x)) / area;
        const double share = mix.opacity / 256.0;
        ASSERT_NEAR(out.row(y)[x], pattern.row(y)[x] * (1 - share) + plain_colour(colours, ramp) * share, 2.5)
            << i;
      }
    }
  }
  EXPECT_GT(compared, 10000);
}

// Slivers, whose gradients are clamped, go beyond what their corners have.
TEST(RasteriserInterior, SliversStayBetweenTheColours) {
  std::mt19937 random(5);
  const auto within = [&](int n) {
    return static_cast<int>(random() % static_cast<unsigned>(2 * n + 1)) - n;
  };
  const Plane pattern(kWidth, kHeight, 250);
  int drawn = 0;
  for (int i = 0; i < 20000; ++i) {
    const glm::ivec2 centre(static_cast<int>(random() % kWidth) * 64 + 32,
                            static_cast<int>(random() % kHeight) * 64 + 32);
    const glm::ivec2 along(within(1 << 20), within(1 << 20)), side(within(2), within(2));
    const TexturedTriangle t = {
        {{centre - along, {}, 0}, {centre + along + side, {}, 0}, {centre + along - side, {}, 0}}};
    DepthPlane depth;
    const Plane out = mixed(t, PlaneScale::kLuma, pattern, {{0, 256, 0}, 256}, {60, 100, 80}, depth);
    for (std::size_t k = 0; k < out.samples.size(); ++k) {
      if (depth.depth[k] != 0) continue;
      ++drawn;
      ASSERT_TRUE(out.samples[k] >= 60 && out.samples[k] <= 100) << static_cast<int>(out.samples[k]);
    }
  }
  EXPECT_GT(drawn, 5000);
}

}  // namespace
}  // namespace fbs
