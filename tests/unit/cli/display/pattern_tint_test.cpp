#include "cli/display/pattern_tint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "decoder/head/mouth_interior.h"
#include "tests/unit/toy_scene.h"

namespace fbs::cli {
namespace {

constexpr int kRounding = 3;  ///< of colours in 8-bit YCbCr

int distance(const Bgr& a, const Bgr& b) {
  int most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

Bgr at(const RgbImage& image, int x, int y) {
  const std::uint8_t* p = &image.samples[3 * (static_cast<std::size_t>(y) * image.width + x)];
  return {p[0], p[1], p[2]};
}

/// Among the landmark's chroma sample and its neighbours, the colour nearest to `colour`: at the lips a
/// region is narrow.
int nearest(const RgbImage& image, const Scene& scene, const State& state, std::size_t landmark,
            const Bgr& colour) {
  const glm::ivec3 p = scene.geometry->project_vertices(state)[vertex_of_landmark(landmark)];
  int least = 255;
  for (int dy = -2; dy <= 2; ++dy)
    for (int dx = -2; dx <= 2; ++dx)
      least = std::min(least, distance(at(image, (p.x >> 6) + dx, (p.y >> 6) + dy), colour));
  return least;
}

/// Patterns of pictures 0 and 40.
Scene two_patterns() {
  Scene scene = toy_scene(noise_picture(160, 128, 1));
  State later = toy_state();
  later.picture = 40;
  scene.patterns.push_back(make_pattern(noise_picture(160, 128, 2), later, scene.geometry));
  return scene;
}

State state_at(std::int32_t picture, BlendMode mode) {
  State state = toy_state();
  state.picture = picture;
  state.blend.fill(mode);
  return state;
}

RgbImage tint(const Scene& scene, const State& state, const std::vector<std::size_t>& in_slot) {
  auto out = pattern_tint(scene, state, in_slot);
  EXPECT_TRUE(out);
  return std::move(*out);
}

void expect_all(const RgbImage& image, const Bgr& colour) {
  ASSERT_EQ(image.samples.size(), 3U * 160 * 128);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      ASSERT_LE(distance(at(image, x, y), colour), kRounding) << x << ' ' << y;
}

TEST(PatternTint, ColoursOfPatternsDiffer) {
  for (std::size_t a = 0; a < kPatternColourCount; ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_GE(distance(pattern_colour(a), pattern_colour(b)), 30) << a << ' ' << b;
}

TEST(PatternTint, ColourIsThatOfTheNumberWhateverTheSlot) {
  const Scene scene = two_patterns();
  expect_all(tint(scene, state_at(20, BlendMode::kStillBefore), {4, 7}), pattern_colour(4));
  expect_all(tint(scene, state_at(20, BlendMode::kStillAfter), {4, 7}), pattern_colour(7));
  expect_all(tint(scene, state_at(20, BlendMode::kStillAfter), {9, 0}), pattern_colour(0));
}

TEST(PatternTint, ColoursMixAsWeightsDo) {
  const RgbImage image = tint(two_patterns(), state_at(10, BlendMode::kByTime), {0, 1});
  Bgr mean;
  for (std::size_t i = 0; i < mean.size(); ++i)
    mean[i] = static_cast<std::uint8_t>((3 * pattern_colour(0)[i] + pattern_colour(1)[i]) / 4);
  expect_all(image, mean);
}

TEST(PatternTint, RegionHasTheColourOfItsPatternWhereTheFaceIs) {
  const Scene scene = two_patterns();
  State state = state_at(20, BlendMode::kStillBefore);
  state.pose[kShiftX] += 20 * 64;
  state.blend[static_cast<std::size_t>(Region::kMouth)] = BlendMode::kStillAfter;
  const RgbImage image = tint(scene, state, {0, 1});
  EXPECT_LE(nearest(image, scene, state, 62, pattern_colour(1)), kRounding) << "lips";
  EXPECT_LE(nearest(image, scene, state, 27, pattern_colour(0)), kRounding) << "nose";
  EXPECT_LE(distance(at(image, 3, 3), pattern_colour(0)), kRounding) << "ground";
}

// Light is added to luma, and the interior covers patterns with a shut mouth: neither may change a colour.
TEST(PatternTint, LightAndMouthInteriorDoNotShow) {
  Scene scene = two_patterns();
  State lit = scene.patterns[0].seen;
  lit.light[kLightGain] = 300;
  scene.patterns.replace(0, make_pattern(scene.patterns[0].picture, lit, scene.geometry));
  State state = state_at(0, BlendMode::kByTime);
  state.light[kLightOffset] = 40 * 16;
  state.interior.fill(-100 * 16);
  const Feature& lips = feature(FeatureId::kMouthInner);
  for (const int lower : {4, 5, 6, 7}) state.control[lips.first_control + lower].y = 1200;
  const ScreenMesh mesh = scene.geometry->screen_mesh(state);
  ASSERT_GT(interior_opacity(mesh.mouth_gap, scene.patterns[0].texture.mouth_gap), 0)
      << "the case must occur";
  expect_all(tint(scene, state, {3, 5}), pattern_colour(3));
}

TEST(PatternTint, SceneWithoutAFaceIsTinted) {
  Scene scene = two_patterns();
  scene.geometry.reset();
  expect_all(tint(scene, state_at(0, BlendMode::kByTime), {6, 2}), pattern_colour(6));
}

TEST(PatternTint, SceneWithoutPatternIsAnError) {
  Scene scene = two_patterns();
  scene.patterns.clear();
  EXPECT_EQ(pattern_tint(scene, toy_state(), {}).error().code, ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace fbs::cli
