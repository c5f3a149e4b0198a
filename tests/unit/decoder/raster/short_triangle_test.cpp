#include "decoder/raster/short_triangle.h"

#include <gtest/gtest.h>

#include <vector>

#include "common/state.h"
#include "tests/unit/decoder/raster/textured_triangle.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

/// A triangle that can be shortened, until a test changes it.
struct Case {
  Plane texture = noise_plane(64, 48, 1), target{64, 48};
  PlaneScale scale = PlaneScale::kLuma;
  TexturedTriangle triangle = in_place({300, 250}, {1500, 400}, {700, 1700});
  SampleArea area = whole(target);
  Light light{{10, 20, 30}, {40, 50, 60}};
  bool has_light = false, has_depth = true;
  int stills = 0;  ///< still sources that are blended with it
  glm::ivec2 still_by{0, 0};
  DepthPlane depth;

  [[nodiscard]] std::optional<ShortTriangle> shortened() {
    const std::array<ConstPlaneView, 2> from{texture, texture};
    const std::array<PlaneView, 2> to{target, target};
    const std::size_t planes = plane_count(scale);
    depth.reset(target.width, target.height, whole(target));
    const TriangleSetup setup(screen_of(triangle), scale);
    EXPECT_TRUE(setup.faces_viewer());
    Finish finish;
    if (has_light) finish.light = &light;
    std::vector<TextureSource> sources{source_of(triangle, std::span(from).first(planes), finish)};
    for (int k = 0; k < stills; ++k) {
      sources.push_back(source_of(triangle, std::span(from).first(planes)));
      for (std::size_t i = 0; i < 3; ++i) sources.back().corners[i] = triangle[i].screen + still_by;
    }
    if (stills > 0) sources[0].weight = {100, 200, 300};
    return shorten(setup, screen_of(triangle), sources,
                   {scale, std::span(to).first(planes), area, has_depth ? &depth : nullptr});
  }
  [[nodiscard]] bool fits() { return shortened().has_value(); }
};

TEST(ShortTriangle, HasTheBoxOfItsSamples) {
  Case c;
  const auto t = c.shortened();
  ASSERT_TRUE(t);
  EXPECT_EQ(t->box.x0, 4);
  EXPECT_EQ(t->box.x1, 24);
  EXPECT_EQ(t->box.y0, (250 - 32) / 64);
  EXPECT_EQ(t->box.y1, (1700 - 32) / 64 + 1);
  c.area = {7, 5, 20, 11};
  const auto clipped = c.shortened();
  ASSERT_TRUE(clipped);
  EXPECT_EQ(clipped->box.x0, 7);
  EXPECT_EQ(clipped->box.x1, 20);
  EXPECT_EQ(clipped->box.y0, 5);
  EXPECT_EQ(clipped->box.y1, 11);
  c.area = {30, 5, 40, 11};
  EXPECT_FALSE(c.fits()) << "nothing is to be drawn";
}

// In place: sample (x, y) shows sample (x, y), and places count from centres.
TEST(ShortTriangle, QuantitiesCountFromTheBox) {
  Case c;
  c.triangle[1].depth = c.triangle[1].screen.x - c.triangle[0].screen.x;
  c.triangle[2].depth = c.triangle[2].screen.x - c.triangle[0].screen.x;
  c.has_light = true;
  c.light = {{7, 7, 7}, {-9, -9, -9}};
  const auto t = c.shortened();
  ASSERT_TRUE(t);
  EXPECT_EQ(t->u.first, t->box.x0 << 16);
  EXPECT_EQ(t->u.dx, 1 << 16);
  EXPECT_EQ(t->u.dy, 0);
  EXPECT_EQ(t->v.first, t->box.y0 << 16);
  EXPECT_EQ(t->v.dx, 0);
  EXPECT_EQ(t->v.dy, 1 << 16);
  EXPECT_EQ(t->depth.first, t->box.x0 * 64 + 32 - 300);
  EXPECT_EQ(t->depth.dx, 64);
  EXPECT_EQ(t->depth.dy, 0);
  EXPECT_TRUE(t->has_light);
  EXPECT_EQ(t->offset.first, 7 << 16);
  EXPECT_EQ(t->gain.first, -9 * (1 << 16));
  EXPECT_EQ(t->gain.dx, 0);
}

/// A case whose texture is moved by some samples.
Case moved(int x, int y, PlaneScale scale) {
  Case c;
  c.scale = scale;
  const int one = 1 << static_cast<int>(scale);
  c.triangle = in_place({4 * one, 3 * one}, {20 * one, 3 * one}, {4 * one, 20 * one});
  for (TexturedVertex& v : c.triangle) v.texture += glm::ivec2(x, y) * one;
  return c;
}

// The triangle's texture has columns 4 to 20 and rows 3 to 20; the plane has 64 columns and 48 rows.
TEST(ShortTriangle, TexturesAtTheBorderAreRefused) {
  for (const PlaneScale scale : {PlaneScale::kLuma, PlaneScale::kChroma}) {
    EXPECT_TRUE(moved(0, 0, scale).fits());
    EXPECT_TRUE(moved(-2, 0, scale).fits());
    EXPECT_FALSE(moved(-3, 0, scale).fits()) << "left";
    EXPECT_TRUE(moved(0, -1, scale).fits());
    EXPECT_FALSE(moved(0, -2, scale).fits()) << "above";
    EXPECT_TRUE(moved(64 - 20 - kReadColumns - 1, 0, scale).fits());
    EXPECT_FALSE(moved(64 - 20 - kReadColumns, 0, scale).fits()) << "right";
    EXPECT_TRUE(moved(0, 48 - 20 - kReadRows - 2, scale).fits());
    EXPECT_FALSE(moved(0, 48 - 20 - kReadRows - 1, scale).fits()) << "below";
    EXPECT_FALSE(moved(-10000, 0, scale).fits());
    EXPECT_FALSE(moved(0, 10000, scale).fits());
  }
}

// A sliver across which something changes much: clamped, or beyond 32 bits at the other side of the box.
TEST(ShortTriangle, SteepGradientsAreRefused) {
  Case c;
  c.triangle = {{{{0, 0}, {500, 500}}, {{4000, 3001}, {502, 500}}, {{3999, 3001}, {501, 500}}}};
  EXPECT_TRUE(c.fits());
  Case steep_texture = c;
  steep_texture.triangle[2].texture = {500, 1200};
  EXPECT_FALSE(steep_texture.fits());
  Case steep_depth = c;
  steep_depth.triangle[2].depth = 1 << 28;
  EXPECT_FALSE(steep_depth.fits());
  Case steep_light = c;
  steep_light.has_light = true;
  steep_light.light = {{10, 10, 10}, {20, 20, 20}};
  EXPECT_TRUE(steep_light.fits());
  steep_light.light.offset = {0, 0, 4000};
  EXPECT_FALSE(steep_light.fits());
  steep_light.light = {{0, 0, 0}, {0, 0, 4000}};
  EXPECT_FALSE(steep_light.fits());
}

TEST(ShortTriangle, DepthsThatDoNotFitAreRefused) {
  Case c;
  for (const int far : {-(1 << 29), 1 << 29}) {
    for (TexturedVertex& v : c.triangle) v.depth = far;
    EXPECT_TRUE(c.fits());
    for (TexturedVertex& v : c.triangle) v.depth = 2 * far;
    EXPECT_FALSE(c.fits());
  }
}

// light_row() clamps there.
TEST(ShortTriangle, LightAtItsLimitIsRefused) {
  for (const bool gain : {false, true}) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      for (const int sign : {-1, 1}) {
        Case c;
        c.has_light = true;
        c.light = {};
        (gain ? c.light.gain : c.light.offset)[corner] = sign * (kMaxLight - 1);
        EXPECT_TRUE(c.fits());
        (gain ? c.light.gain : c.light.offset)[corner] = sign * kMaxLight;
        EXPECT_FALSE(c.fits());
      }
    }
  }
}

TEST(ShortTriangle, IsBlendedWithTwoStillSourcesAtMost) {
  Case c;
  for (c.stills = 1; c.stills <= 2; ++c.stills) {
    const auto t = c.shortened();
    ASSERT_TRUE(t);
    EXPECT_NEAR(t->weight[0].first, 100 << 16, 20 << 16)
        << "at the box's corner, near the first of the triangle";
  }
  c.stills = 3;
  EXPECT_FALSE(c.fits());
  c.stills = 1;
  c.still_by = {1, 0};
  EXPECT_FALSE(c.fits()) << "not where the picture has it";
}

TEST(ShortTriangle, NeedsDepth) {
  Case c;
  c.has_depth = false;
  EXPECT_FALSE(c.fits());
}

}  // namespace
}  // namespace fbs
