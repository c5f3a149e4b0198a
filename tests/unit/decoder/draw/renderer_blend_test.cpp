// The renderer's pictures of scenes with several patterns.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "decoder/blend/picture_blend.h"
#include "decoder/draw/renderer.h"
#include "decoder/head/head_mesh.h"
#include "tests/unit/decoder/head_area.h"

namespace fbs {
namespace {

State any_state(std::mt19937& random, std::int32_t picture) {
  State state = toy_state(70 + static_cast<int>(random() % 20), 45 + static_cast<int>(random() % 10));
  for (const int axis : {kPitch, kYaw, kRoll}) state.pose[axis] = static_cast<int>(random() % 4000) - 2000;
  for (glm::ivec2& c : state.control)
    c = {static_cast<int>(random() % 401) - 200, static_cast<int>(random() % 401) - 200};
  state.body = {static_cast<int>(random() % 400) - 200, static_cast<int>(random() % 400) - 200, 20, -10};
  state.light[kLightOffset] = static_cast<int>(random() % 200);
  state.picture = picture;
  return state;
}

void set_modes(std::mt19937& random, State& state) {
  for (BlendMode& mode : state.blend) mode = static_cast<BlendMode>(random() % kBlendModeCount);
}

SurroundMap mixed_surround() {
  SurroundMap map = even_surround(10, 8, 0);
  for (int r = 1; r < 8; ++r)
    for (int c = 1; c < 10; ++c) {
      const int k = r * 11 + c;
      map.head[k] = static_cast<std::uint8_t>(r < 4 ? c % 5 : 0);
      map.body[k] = static_cast<std::uint8_t>(map.head[k] == kFollowOne ? 0 : r % 5);
    }
  return map;
}

/// A scene with `count` patterns of one picture, seen in one state but at different times.
Scene repeated(const Picture& picture, const State& seen, int count) {
  Scene scene = toy_scene(picture, mixed_surround());
  scene.patterns.clear();
  for (int k = 0; k < count; ++k) {
    State at = seen;
    at.picture = 10 * k;
    scene.patterns.push_back(make_pattern(picture, at, scene.geometry));
  }
  return scene;
}

// Whatever the blend: warped patterns that agree are one.
TEST(RendererBlend, IdenticalPatternsDrawThePictureOfOne) {
  std::mt19937 random(1);
  for (int i = 0; i < 60; ++i) {
    const Picture picture = noise_picture(160, 128, static_cast<unsigned>(i));
    const State seen = any_state(random, 0);
    State state = any_state(random, static_cast<int>(random() % 60));
    const Picture expected = rendered(repeated(picture, seen, 1), state);
    for (BlendMode& mode : state.blend) do
        mode = static_cast<BlendMode>(random() % kBlendModeCount);
      while (mode == BlendMode::kHalfStill || mode == BlendMode::kStillBefore ||
             mode == BlendMode::kStillAfter);
    ASSERT_EQ(rendered(repeated(picture, seen, 2 + i % 5), state), expected) << i;
  }
}

// Where nothing has moved still sources show what warped ones do.
TEST(RendererBlend, StillPatternsInTheirOwnStateDrawThePattern) {
  std::mt19937 random(2);
  for (int i = 0; i < 60; ++i) {
    const Picture picture = smooth_picture(160, 128, static_cast<unsigned>(i));
    State state = any_state(random, 0);
    const Scene scene = repeated(picture, state, 4);
    state.picture = static_cast<int>(random() % 40);
    set_modes(random, state);
    SCOPED_TRACE(i);
    expect_shows(rendered(scene, state), picture, head_area(scene, state), {2, 64});
  }
}

TEST(RendererBlend, StillModesShowAPatternAsItIsWhateverMoves) {
  std::mt19937 random(3);
  Scene scene = toy_scene(noise_picture(160, 128, 1), mixed_surround());
  State later = any_state(random, 40);
  scene.patterns.push_back(make_pattern(noise_picture(160, 128, 2), later, scene.geometry));
  State state = any_state(random, 20);
  state.blend.fill(BlendMode::kStillBefore);
  EXPECT_EQ(rendered(scene, state), scene.patterns[0].picture);
  state.blend.fill(BlendMode::kStillAfter);
  EXPECT_EQ(rendered(scene, state), scene.patterns[1].picture);
}

TEST(RendererBlend, CrossFadeOfPatternsAtRestIsTheirWeightedMean) {
  Scene scene = toy_scene(smooth_picture(160, 128, 1), mixed_surround());
  State later = toy_state();
  later.picture = 40;
  scene.patterns.push_back(make_pattern(smooth_picture(160, 128, 2), later, scene.geometry));
  State state = toy_state();
  state.picture = 10;
  state.blend.fill(BlendMode::kByTime);
  const auto mean_of = [&](Plane Picture::*plane) {
    const Plane &a = scene.patterns[0].picture.*plane, &b = scene.patterns[1].picture.*plane;
    Plane mean = a;
    for (std::size_t i = 0; i < a.samples.size(); ++i)
      mean.samples[i] = static_cast<std::uint8_t>((3 * a.samples[i] + b.samples[i] + 2) / 4);
    return mean;
  };
  Picture expected(160, 128);
  expected.y = mean_of(&Picture::y);
  expected.u = mean_of(&Picture::u);
  expected.v = mean_of(&Picture::v);
  expect_shows(rendered(scene, state), expected, head_area(scene, state), {2, 24});
}

TEST(RendererBlend, SceneWithoutGeometryCrossFadesItsPatterns) {
  Scene scene;
  scene.setup = toy_setup();
  State later;
  later.picture = 20;
  scene.patterns.push_back(make_pattern(noise_picture(160, 128, 1), {}, scene.geometry));
  scene.patterns.push_back(make_pattern(noise_picture(160, 128, 2), later, scene.geometry));
  State state;
  state.picture = 5;
  state.blend.fill(BlendMode::kByTime);
  const Picture out = rendered(scene, state);
  const Plane &a = scene.patterns[0].picture.y, &b = scene.patterns[1].picture.y;
  for (std::size_t i = 0; i < a.samples.size(); ++i)
    ASSERT_EQ(out.y.samples[i], (3 * a.samples[i] + b.samples[i] + 2) / 4);
}

TEST(RendererBlend, RegionsAreBlendedApart) {
  Picture picture(160, 128);
  picture.y = Plane(160, 128, 60);
  Scene scene = toy_scene(picture, even_surround(10, 8, 0));
  State later = toy_state();
  later.picture = 40;
  picture.y = Plane(160, 128, 180);
  scene.patterns.push_back(make_pattern(picture, later, scene.geometry));
  State state = toy_state();
  state.picture = 20;
  state.blend.fill(BlendMode::kStillBefore);
  state.blend[static_cast<std::size_t>(Region::kMouth)] = BlendMode::kStillAfter;
  const Picture out = rendered(scene, state);
  const auto vertices = scene.geometry->project_vertices(state);
  const auto luma_at = [&](std::size_t landmark) {
    const glm::ivec3 p = vertices[vertex_of_landmark(landmark)];
    return static_cast<int>(out.y.row(p.y >> 6)[p.x >> 6]);
  };
  EXPECT_GT(luma_at(62), 170) << "lips";
  EXPECT_LT(luma_at(27), 70) << "nose";
  EXPECT_EQ(out.y.row(3)[3], 60) << "ground";
  for (const std::uint8_t s : out.y.samples) ASSERT_TRUE(s >= 60 && s <= 180);
}

TEST(RendererBlend, PatternsOfDifferentSizesAreAnError) {
  Scene scene = toy_scene(noise_picture(160, 128, 1));
  Pattern wider = scene.patterns[0];
  wider.picture = noise_picture(162, 128, 1);
  scene.patterns.push_back(std::move(wider));
  Picture out;
  EXPECT_EQ(Renderer().render(scene, toy_state(), out).error().code, ErrorCode::kInvalidArgument);
}

TEST(RendererBlend, SurvivesEveryStateOfAStream) {
  std::mt19937 random(5);
  Renderer renderer;
  Picture out;
  for (int i = 0; i < 60; ++i) {
    Scene scene = toy_scene(noise_picture(65, 64, 6), even_surround(4, 3, static_cast<int>(random() % 5)));
    for (unsigned n = 1 + random() % 12; n > 0; --n) {
      State seen = random_state(random);
      seen.picture = static_cast<std::int32_t>(random() >> 1);
      scene.patterns.push_back(make_pattern(noise_picture(65, 64, n), seen, scene.geometry));
    }
    State state = random_state(random);
    state.picture = static_cast<std::int32_t>(random() >> 1);
    set_modes(random, state);
    ASSERT_TRUE(renderer.render(scene, state, out));
  }
}

}  // namespace
}  // namespace fbs
