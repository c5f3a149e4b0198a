// The renderer's pictures under a light.
#include <gtest/gtest.h>

#include <algorithm>

#include "decoder/draw/renderer.h"
#include "tests/unit/decoder/head_area.h"

namespace fbs {
namespace {

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
  scene.patterns.replace(0, make_pattern(std::move(picture), seen, scene.geometry));
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
  const Picture unlit = rendered(scene, toy_state());
  EXPECT_EQ(out.u, unlit.u);
  EXPECT_EQ(out.v, unlit.v);
  for (const auto s : out.y.samples) ASSERT_TRUE(s >= 100 && s <= 130);
}

// Across the ring the light falls from the outline's to none: no edge shows.
TEST(RendererLight, FadesOverTheRing) {
  const Scene scene = grey_scene(100);
  State state = toy_state();
  state.light[kLightOffset] = 16 * 30;
  const Picture out = rendered(scene, state);
  const ScreenMesh mesh = scene.geometry->screen_mesh(state);
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

// Light is added to the pattern: a head that rotates keeps its light.
TEST(RendererLight, MovesWithTheHead) {
  const Scene scene = grey_scene(100);
  State state = toy_state(90, 60);
  state.pose[kYaw] = 2500;
  state.light = {16 * 20, 0, 16 * 20, 0};
  EXPECT_NEAR(luma_at(scene, state, kNoseTip), 120, 2);
  EXPECT_GT(luma_at(scene, state, 54), luma_at(scene, state, 48) + 5) << "corners of the mouth";
}

// The pattern was seen under its own light: the difference is added.
TEST(RendererLight, IsTheDifferenceToThePatternsLight) {
  const std::array<std::int32_t, kLightCount> own = {16 * 30, 0, 0, 0};
  const Scene scene = grey_scene(100, own);
  State state = toy_state();
  EXPECT_EQ(luma_at(scene, state, kNoseTip), 70) << "taken off";
  state.light = own;
  EXPECT_EQ(luma_at(scene, state, kNoseTip), 100);
  state.light[kLightOffset] = 16 * 45;
  EXPECT_EQ(luma_at(scene, state, kNoseTip), 115);
  state.light = {0, 16 * 16, 0, 0};
  // Taken back, the grey is 192 - 64 * 10 / 138, rounded.
  EXPECT_EQ(luma_at(grey_scene(192, {0, 16 * 10, 0, 0}), state, kNoseTip), 197) << "so is the gain";
}

// As long as no sample reaches black or white without its light.
TEST(RendererLight, OfThePatternReproducesIt) {
  std::mt19937 random(6);
  Picture picture = smooth_picture(160, 128, 7);
  for (std::uint8_t& s : picture.y.samples) s = static_cast<std::uint8_t>(96 + s / 4);
  for (int i = 0; i < 20; ++i) {
    Scene scene = toy_scene(picture);
    State seen = toy_state();
    for (std::int32_t& n : seen.light) n = static_cast<int>(random() % 401) - 200;
    scene.patterns.replace(0, make_pattern(picture, seen, scene.geometry));
    SCOPED_TRACE(i);
    expect_shows(rendered(scene, seen), picture, head_area(scene, seen), {2, 24});
    ASSERT_NE(rendered(scene, toy_state()).y, rendered(scene, seen).y) << i;
  }
}

}  // namespace
}  // namespace fbs
