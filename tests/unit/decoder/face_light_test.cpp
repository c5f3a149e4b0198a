// Light on its way from the state to samples: draw_triangle with a Light, and the renderer's pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "decoder/renderer.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr int kWidth = 24, kHeight = 20;

/// Draws a pattern in its place under a light, over the lower left half of the picture.
Plane lit(const Plane& pattern, const Light& light, const Shade* shade = nullptr) {
  Plane target(pattern.width, pattern.height);
  const int right = 64 * pattern.width, bottom = 64 * pattern.height;
  const std::array<glm::ivec2, 3> p = {glm::ivec2(0, 0), {right, bottom}, {0, bottom}};
  const RasterTriangle t = {{{p[0], p[0]}, {p[1], p[1]}, {p[2], p[2]}}};
  const SampleArea area{0, 0, pattern.width, pattern.height};
  DepthPlane depth;
  depth.reset(pattern.width, pattern.height, area);
  const PlanePair pair{&pattern, &target, {50, 50, 50}};
  draw_triangle(t, PlaneScale::kLuma, {&pair, 1}, area, &depth, {.light = &light, .shade = shade});
  return target;
}

Light even(std::int32_t offset, std::int32_t gain) {
  return {{offset, offset, offset}, {gain, gain, gain}};
}

TEST(Light, NoneLeavesThePatternAsItIs) {
  const Plane pattern = noise_plane(kWidth, kHeight, 1);
  const Plane out = lit(pattern, Light{});
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < y; ++x) ASSERT_EQ(out.row(y)[x], pattern.row(y)[x]);
}

// 1/16 grey level, rounded to nearest with halves up.
TEST(Light, OffsetIsAddedInSixteenthsAndRounded) {
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

TEST(Light, GainIsAboutTheMiddleGrey) {
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

TEST(Light, IsLinearOverTheTriangle) {
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

TEST(Light, FallsOnTheFirstPlaneAlone) {
  const Plane luma(kWidth, kHeight, 90), other(kWidth, kHeight, 90);
  Plane to_luma(kWidth, kHeight), to_other(kWidth, kHeight);
  const std::array<PlanePair, 2> planes = {PlanePair{&luma, &to_luma}, PlanePair{&other, &to_other}};
  const RasterTriangle t = {{{{0, 0}, {0, 0}}, {{2560, 0}, {2560, 0}}, {{0, 2560}, {0, 2560}}}};
  DepthPlane depth;
  depth.reset(kWidth, kHeight, {0, 0, kWidth, kHeight});
  const Light light = even(160, 0);
  draw_triangle(t, PlaneScale::kLuma, planes, {0, 0, kWidth, kHeight}, &depth, {.light = &light});
  EXPECT_EQ(to_luma.row(2)[2], 100);
  EXPECT_EQ(to_other.row(2)[2], 90);
}

TEST(Light, FallsOnThePatternAndNotOnTheMouthsInside) {
  const Plane grey(kWidth, kHeight, 100);
  const Light light = even(16 * 40, 0);
  const Shade half{{0, 0, 0}, 128}, all{{0, 0, 0}, 256};
  EXPECT_EQ(lit(grey, light, &all).row(15)[3], 50);
  EXPECT_EQ(lit(grey, light, &half).row(15)[3], (140 + 50) / 2);
}

/// A triangle a unit or two wide and as long as the screen allows, about a sample's centre.
RasterTriangle sliver(std::mt19937& random) {
  const auto within = [&](int n) {
    return static_cast<int>(random() % static_cast<unsigned>(2 * n + 1)) - n;
  };
  const glm::ivec2 centre(static_cast<int>(random() % 32) * 64 + 32,
                          static_cast<int>(random() % 24) * 64 + 32);
  const glm::ivec2 along(within(1 << 20), within(1 << 20)), side(within(2), within(2));
  return {{{centre - along, {}, 0}, {centre + along + side, {}, 0}, {centre + along - side, {}, 0}}};
}

/// SPEC 10.7 with n = 22 and o = 16, clamped: what light adds at the centre of a sample, 2^-20 grey level.
std::int64_t plain_light(const RasterTriangle& t, const std::array<std::int32_t, 3>& v, int x, int y) {
  using std::int64_t;
  const int64_t ax = t[1].screen.x - t[0].screen.x, ay = t[1].screen.y - t[0].screen.y;
  const int64_t bx = t[2].screen.x - t[0].screen.x, by = t[2].screen.y - t[0].screen.y;
  const int64_t area = ax * by - ay * bx, most = int64_t{1} << 30;
  const int64_t va = v[1] - v[0], vb = v[2] - v[0];
  const int64_t gx = std::clamp(((va * by - vb * ay) << 22) / area, -most, most),
                gy = std::clamp(((vb * ax - va * bx) << 22) / area, -most, most);
  const int64_t dx = 64 * x + 32 - t[0].screen.x, dy = 64 * y + 32 - t[0].screen.y;
  const int64_t at = (int64_t{v[0]} << 16) + ((gx * dx + gy * dy) >> 6);
  return std::clamp<int64_t>(at, -(kMaxLight << 16), kMaxLight << 16);
}

// Corners as far away and lights as strong as a stream can have them: nothing overflows (sanitizers).
TEST(Light, IsThatOfThePlainRuleOnHostileTriangles) {
  std::mt19937 random(5);
  int drawn = 0;
  for (int i = 0; i < 30000; ++i) {
    const RasterTriangle t = sliver(random);
    const Plane pattern(32, 24, static_cast<std::uint8_t>(random()));
    Light light;
    for (auto* corners : {&light.offset, &light.gain})
      for (std::int32_t& c : *corners)
        c = random() % 2 == 0 ? static_cast<int>(random() % 400) : random() % 2 == 0 ? kMaxLight : -kMaxLight;
    Plane target(32, 24, 77);
    DepthPlane depth;
    depth.reset(32, 24, {0, 0, 32, 24});
    const PlanePair pair{&pattern, &target};
    draw_triangle(t, PlaneScale::kLuma, {&pair, 1}, {0, 0, 32, 24}, &depth, {.light = &light});
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

/// The toy head in one grey before the same grey.
/// @param light  under which it was seen
Scene grey_scene(std::uint8_t grey, const std::array<std::int32_t, kLightCount>& light = {}) {
  Picture picture(160, 128);
  picture.y = Plane(160, 128, grey);
  picture.u = noise_plane(80, 64, 1);
  picture.v = noise_plane(80, 64, 2);
  Scene scene = toy_scene(picture);
  State seen = toy_state();
  seen.light = light;
  scene.patterns[0].seen = scene.geometry->project(seen);
  return scene;
}

/// Luma where a landmark is.
int luma_at(const Scene& scene, const State& state, std::size_t landmark) {
  const auto vertices = scene.geometry->project_vertices(state);
  const glm::ivec3 p = vertices[vertex_of_landmark(landmark)];
  return rendered(scene, state).y.row(p.y >> 6)[p.x >> 6];
}

constexpr std::size_t kNoseTip = 30, kJawRight = 3, kJawLeft = 13, kChin = 8, kNoseBridge = 27;

TEST(RendererLight, FallsOnTheFaceAndOnLumaAlone) {
  const Scene scene = grey_scene(100);
  State state = toy_state();
  state.light[kLightOffset] = 16 * 30;
  const Picture out = rendered(scene, state);
  EXPECT_EQ(luma_at(scene, state, kNoseTip), 130);
  for (const auto& [x, y] : {std::pair{2, 2}, {150, 60}, {80, 125}}) EXPECT_EQ(out.y.row(y)[x], 100);
  EXPECT_EQ(out.u, scene.patterns[0].picture.u);
  EXPECT_EQ(out.v, scene.patterns[0].picture.v);
  for (const auto s : out.y.samples) ASSERT_TRUE(s >= 100 && s <= 130);
}

// Across the ring the light goes from the outline's to none: no edge shows.
TEST(RendererLight, FadesOverTheRing) {
  const Scene scene = grey_scene(100);
  State state = toy_state();
  state.light[kLightOffset] = 16 * 30;
  const Picture out = rendered(scene, state);
  const ScreenMesh mesh = scene.geometry->project(state);
  for (std::size_t i = 0; i < generic_head().outline.size(); ++i) {
    const glm::ivec2 edge(mesh.head[generic_head().outline[i]]), ring(mesh.head[kVertexCount + i]);
    const glm::ivec2 middle = (edge + ring) / 2 / 64;
    EXPECT_NEAR(out.y.row(middle.y)[middle.x], 115, 9) << i;
  }
}

TEST(RendererLight, GainStretchesAboutTheMiddleGrey) {
  State state = toy_state();
  state.light[kLightGain] = 16 * 16;
  EXPECT_EQ(luma_at(grey_scene(192), state, kNoseTip), 208);
  EXPECT_EQ(luma_at(grey_scene(128), state, kNoseTip), 128);
  EXPECT_EQ(luma_at(grey_scene(64), state, kNoseTip), 48);
}

TEST(RendererLight, SlopesBrightenOneSide) {
  const Scene scene = grey_scene(100);
  State state = toy_state();
  state.light[kLightSlopeX] = 16 * 40;
  const int right = luma_at(scene, state, kJawRight), left = luma_at(scene, state, kJawLeft);
  EXPECT_GT(left, 115) << "the picture's right";
  EXPECT_LT(right, 85);
  EXPECT_NEAR(luma_at(scene, state, kNoseTip), 100, 2);
  state.light = {0, 0, 0, 16 * 40};
  EXPECT_GT(luma_at(scene, state, kChin), luma_at(scene, state, kNoseTip) + 5);
  EXPECT_GT(luma_at(scene, state, kNoseTip), luma_at(scene, state, kNoseBridge) + 5);
}

// The pattern is what light is added to: a head that turns keeps what its light says.
TEST(RendererLight, GoesWithTheHead) {
  const Scene scene = grey_scene(100);
  State state = toy_state(90, 60);
  state.pose[kYaw] = 2500;
  state.light = {16 * 20, 0, 16 * 20, 0};
  EXPECT_NEAR(luma_at(scene, state, kNoseTip), 120, 2);
  EXPECT_GT(luma_at(scene, state, 54), luma_at(scene, state, 48) + 5) << "corners of the mouth";
}

// The pattern was seen under a light of its own: what is added is what the picture has more.
TEST(RendererLight, IsWhatThePatternHadNot) {
  const std::array<std::int32_t, kLightCount> own = {16 * 30, 0, 0, 0};
  const Scene scene = grey_scene(100, own);
  State state = toy_state();
  EXPECT_EQ(luma_at(scene, state, kNoseTip), 70) << "taken off";
  state.light = own;
  EXPECT_EQ(luma_at(scene, state, kNoseTip), 100);
  state.light[kLightOffset] = 16 * 45;
  EXPECT_EQ(luma_at(scene, state, kNoseTip), 115);
  state.light = {0, 16 * 16, 0, 0};
  EXPECT_EQ(luma_at(grey_scene(192, {0, 16 * 10, 0, 0}), state, kNoseTip), 198) << "so is the gain";
}

TEST(RendererLight, ThatOfThePatternReproducesItExactly) {
  std::mt19937 random(6);
  for (int i = 0; i < 20; ++i) {
    Scene scene = toy_scene(noise_picture(160, 128, 7));
    State seen = toy_state();
    for (std::int32_t& n : seen.light) n = static_cast<int>(random() % 2001) - 1000;
    scene.patterns[0].seen = scene.geometry->project(seen);
    ASSERT_EQ(rendered(scene, seen), scene.patterns[0].picture) << i;
    ASSERT_NE(rendered(scene, toy_state()), scene.patterns[0].picture) << i;
  }
}

}  // namespace
}  // namespace fbs
