#include "encoder/blend/source_samples.h"

#include <gtest/gtest.h>

#include "decoder/head/mouth_interior.h"
#include "encoder/blend/sample_kernels.h"
#include "tests/unit/encoder/blend/blended_scene.h"

namespace fbs {
namespace {

/// Luma drawn from pattern 0 alone, sample by sample.
Plane sampled(const BlendedScene& s, const State& state, bool still) {
  const Pattern& pattern = s.scene.patterns.front();
  const ScreenMesh mesh = s.scene.geometry->screen_mesh(state);
  const VideoFormat& format = s.scene.setup.format;
  const VisibleSurface surface(*s.scene.geometry, mesh, format.width, format.height, 0);
  const PictureMesh picture{surface, mesh, s.scene.setup.mouth, 0};
  const ReducedPlane luma = reduce(pattern.picture.y, 0);
  Plane out(format.width, format.height);
  const ReducedPlane black{luma.width, luma.height, std::vector<float>(luma.samples.size())};
  std::vector<std::int16_t> row(format.width + ShownSamples::kLanes);
  ShownSamples shown(out.samples.size());
  for (const SurfaceRun& run : surface.runs()) {
    const std::size_t begin = shown.size();
    shown.add(run, black);
    shown.differences(triangle_source(picture, run.triangle, pattern.texture, still), luma, begin,
                      shown.size(), row.data());
    for (int i = 0; i < run.count; ++i) out.row(run.row)[run.first + i] = static_cast<std::uint8_t>(row[i]);
  }
  return out;
}

struct Difference {
  int max = 0;
  double mean = 0;        ///< signed
  double beyond_one = 0;  ///< share of samples
};

Difference difference(const Plane& a, const Plane& b) {
  Difference out;
  const auto count = static_cast<double>(a.samples.size());
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    const int d = a.samples[i] - b.samples[i];
    out.max = std::max(out.max, std::abs(d));
    out.mean += d / count;
    if (std::abs(d) > 1) out.beyond_one += 1 / count;
  }
  return out;
}

struct Differences {
  Difference head, surround;
};

Differences against_renderer(const BlendedScene& s, const State& state) {
  const Plane a = sampled(s, state, false), b = rendered(s.scene, state).y;
  const ScreenMesh mesh = s.scene.geometry->screen_mesh(state);
  const VisibleSurface surface(*s.scene.geometry, mesh, a.width, a.height, 0);
  std::array<Plane, 2> x, y;  // of the surround, of the head without the inside of its mouth
  for (const SurfaceRun& run : surface.runs()) {
    const SurfaceTriangle& t = surface.triangles()[run.triangle];
    const std::size_t k = t.head ? 1 : 0;
    if (t.head && is_mouth(generic_head(), t.corners)) continue;
    const auto add = [&](const Plane& from, Plane& to) {
      const std::uint8_t* const first = from.row(run.row) + run.first;
      to.samples.insert(to.samples.end(), first, first + run.count);
    };
    add(a, x[k]), add(b, y[k]);
  }
  return {difference(x[1], y[1]), difference(x[0], y[0])};
}

// Triangles here, patches there: they differ where the grid bends within a patch.
void expect_like_the_renderers(const Difference& surround) {
  EXPECT_LT(surround.beyond_one, 0.12);
  EXPECT_NEAR(surround.mean, 0, 0.1);
}

TEST(SourceSamples, WarpIsTheRenderers) {
  const BlendedScene s(1);
  for (unsigned seed = 1; seed <= 4; ++seed) {
    State state = SeenScene::rest();
    StateMaker maker(seed);
    maker.pose(state), maker.expression(state), maker.lids(state), maker.gaze(state);
    state.body = {200, -90, 40, 60};
    state.ground = {-70, 130, 0, 30};
    const auto [head, surround] = against_renderer(s, state);
    EXPECT_LE(head.max, 2) << "the renderer rounds texture positions: " << seed;
    EXPECT_LT(head.beyond_one, 2e-3) << seed;
    EXPECT_NEAR(head.mean, 0, 0.1) << seed;
    expect_like_the_renderers(surround);
  }
}

TEST(SourceSamples, StillSourceIsThePatternAsItIs) {
  const BlendedScene s(1);
  State state = SeenScene::rest();
  StateMaker maker(3);
  maker.pose(state), maker.light(state), maker.mouth(state);
  EXPECT_EQ(sampled(s, state, true), s.scene.patterns.front().picture.y);
  EXPECT_EQ(rendered(s.scene, with_mode(state, BlendMode::kStillBefore)).y,
            s.scene.patterns.front().picture.y);
}

TEST(SourceSamples, LightIsTheRenderers) {
  const BlendedScene s(1);
  for (unsigned seed = 1; seed <= 4; ++seed) {
    State state = SeenScene::rest();
    StateMaker maker(seed);
    maker.pose(state), maker.light(state);
    const auto [head, surround] = against_renderer(s, state);
    EXPECT_LE(head.max, 6) << "gain is constant along a run: " << seed;
    EXPECT_LT(head.beyond_one, 0.025) << "the pattern's light is taken back in whole greys: " << seed;
    EXPECT_NEAR(head.mean, 0, 0.1) << seed;
    expect_like_the_renderers(surround);
  }
}

TEST(SourceSamples, LightThatThePatternHasIsNotAdded) {
  State lit = SeenScene::rest();
  lit.light = {160, -80, 50, 0, 0, 30, 0};
  BlendedScene s(0);
  s.add_pattern(lit, 7);
  EXPECT_LE(difference(sampled(s, lit, false), s.scene.patterns.front().picture.y).max, 1);
}

TEST(SourceSamples, LightEndsAtBlackAndWhite) {
  const BlendedScene s(1);
  for (const int level : {-200 * 16, 200 * 16}) {
    State state = SeenScene::rest();
    state.light[kLightOffset] = level;
    const auto [head, surround] = against_renderer(s, state);
    EXPECT_LE(head.max, 3) << level;
    EXPECT_LE(surround.max, 1) << level;
  }
}

/// Samples of the mouth interior alone.
Difference inside_mouth(const BlendedScene& s, const State& state) {
  const Plane a = sampled(s, state, false), b = rendered(s.scene, state).y;
  const ScreenMesh mesh = s.scene.geometry->screen_mesh(state);
  const VisibleSurface surface(*s.scene.geometry, mesh, a.width, a.height, 0);
  const PictureMesh picture{surface, mesh, s.scene.setup.mouth, 0};
  Plane x, y;
  for (const SurfaceRun& run : surface.runs()) {
    const TriangleSource source =
        triangle_source(picture, run.triangle, s.scene.patterns.front().texture, false);
    if (!source.light || source.light->opacity == 0) continue;
    x.samples.insert(x.samples.end(), a.row(run.row) + run.first, a.row(run.row) + run.first + run.count);
    y.samples.insert(y.samples.end(), b.row(run.row) + run.first, b.row(run.row) + run.first + run.count);
  }
  EXPECT_GT(x.samples.size(), 50U) << "the mouth is open";
  return difference(x, y);
}

State with_gap(int head_units) {
  State state = SeenScene::rest();
  for (const int c : {4, 5, 6, 7})
    state.control[feature(FeatureId::kMouthInner).first_control + c].y += head_units;
  return state;
}

// The renderer's colours fade towards the lips; here they have their mean opacity.
TEST(SourceSamples, MouthInteriorIsTheRenderersOnTheMean) {
  const BlendedScene s(1);
  for (const int gap : {200, 400, 900}) {
    State state = with_gap(gap);
    state.interior.fill(20 * 16);
    const Difference d = inside_mouth(s, state);
    EXPECT_NEAR(d.mean, 0, 2) << gap;
  }
}

// Colours change along a triangle; it has its mean.
TEST(SourceSamples, MouthInteriorHasItsMeanColour) {
  const BlendedScene s(1);
  State state = with_gap(900);
  state.interior = {40 * 16, 0, -20 * 16};
  EXPECT_NEAR(inside_mouth(s, state).mean, 0, 4);
}

TEST(Reduce, KeepsConstantsAndMeansOfARamp) {
  Plane ramp(37, 22);
  for (int y = 0; y < ramp.height; ++y)
    for (int x = 0; x < ramp.width; ++x) ramp.row(y)[x] = static_cast<std::uint8_t>(4 * x + 3 * y);
  for (int reduction = 0; reduction <= 3; ++reduction) {
    const int n = 1 << reduction;
    const ReducedPlane flat = reduce(Plane(37, 22, 91), reduction), out = reduce(ramp, reduction);
    ASSERT_EQ(out.width, 37 / n) << "what does not fill a square is dropped";
    ASSERT_EQ(out.height, 22 / n);
    ASSERT_EQ(out.samples.size(), static_cast<std::size_t>(out.width) * out.height);
    for (int y = 0; y < out.height; ++y)
      for (int x = 0; x < out.width; ++x) {
        EXPECT_FLOAT_EQ(flat.row(y)[x], 91);
        const double u = n * (x + 0.5) - 0.5, v = n * (y + 0.5) - 0.5;  // middle of the square
        EXPECT_FLOAT_EQ(out.row(y)[x], static_cast<float>(4 * u + 3 * v));
      }
  }
}

TEST(Bilinear, IsExactAtCentresLinearBetweenAndRepeatsTheBorder) {
  ReducedPlane plane{3, 2, {10, 20, 60, 30, 80, 40}};
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x)
      EXPECT_FLOAT_EQ(bilinear(plane, static_cast<float>(x), static_cast<float>(y)), plane.row(y)[x]);
  EXPECT_FLOAT_EQ(bilinear(plane, 0.5F, 0), 15);
  EXPECT_FLOAT_EQ(bilinear(plane, 1, 0.25F), 35);
  EXPECT_FLOAT_EQ(bilinear(plane, 1.5F, 0.5F), 50);
  EXPECT_FLOAT_EQ(bilinear(plane, -7, -3), 10);
  EXPECT_FLOAT_EQ(bilinear(plane, 9, 0.5F), 50);
  EXPECT_FLOAT_EQ(bilinear(plane, 0.5F, 8), 55);
}

TEST(TexturePathIsInside, NeedsAllFourSamplesOfBothEnds) {
  const ReducedPlane plane{8, 6, std::vector<float>(48)};
  const auto inside = [&](float u, float u_step, float v, float v_step, int count) {
    return is_inside({{u, u_step}, {v, v_step}}, count, {plane.width, plane.height});
  };
  EXPECT_TRUE(inside(0, 1, 0, 0, 7));
  EXPECT_FALSE(inside(0, 1, 0, 0, 8)) << "the last has no right neighbour";
  EXPECT_TRUE(inside(6.7F, -1, 4.7F, -0.5F, 7));
  EXPECT_FALSE(inside(6.7F, -1, 4.7F, -0.5F, 8));
  EXPECT_FALSE(inside(2, 0, 5, 0, 1)) << "no row below";
  EXPECT_FALSE(inside(6.9999F, 0, 0, 0, 1)) << "steps that are added up drift";
}

}  // namespace
}  // namespace fbs
