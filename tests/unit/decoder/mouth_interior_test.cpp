// What shows between parted lips, on its way from setup and state to samples: draw_triangle with a Shade, and
// the renderer's pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "decoder/renderer.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr int kWidth = 24, kHeight = 20;

using Colours = std::array<std::uint8_t, 3>;

RasterTriangle in_place(glm::ivec2 a, glm::ivec2 b, glm::ivec2 c) {
  return {{{a, a}, {b, b}, {c, c}}};
}

const RasterTriangle kLarge = in_place({-640, -640}, {5000, -640}, {-640, 5000});  // covers all samples

/// Draws a pattern under a shade. Samples that were drawn have depth 0.
Plane shaded(const RasterTriangle& t, PlaneScale scale, const Plane& pattern, const Shade& shade,
             const Colours& colours, DepthPlane& depth) {
  Plane target(pattern.width, pattern.height);
  const SampleArea area{0, 0, pattern.width, pattern.height};
  depth.reset(pattern.width, pattern.height, area);
  const PlanePair pair{&pattern, &target, colours};
  draw_triangle(t, scale, {&pair, 1}, area, &depth, {.shade = &shade});
  return target;
}

Plane shaded(const Plane& pattern, const Shade& shade, const Colours& colours) {
  DepthPlane depth;
  return shaded(kLarge, PlaneScale::kLuma, pattern, shade, colours, depth);
}

/// SPEC 10.7: the colour at a place of the ramp.
double plain_colour(const Colours& c, double ramp) {
  return ramp < 128 ? c[0] + (c[1] - c[0]) * ramp / 128 : c[1] + (c[2] - c[1]) * (ramp - 128) / 128;
}

TEST(MouthInside, GoesThroughThreeColours) {
  const Plane pattern = noise_plane(kWidth, kHeight, 1);
  const Colours colours = {40, 200, 120};
  const auto at = [&](std::int32_t ramp) {
    const Plane out = shaded(pattern, {{ramp, ramp, ramp}, 256}, colours);
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

TEST(MouthInside, RampStaysBetweenItsEnds) {
  const Plane pattern(kWidth, kHeight, 90);
  EXPECT_EQ(shaded(pattern, {{-300, -300, -300}, 256}, {40, 200, 120}), Plane(kWidth, kHeight, 40));
  EXPECT_EQ(shaded(pattern, {{900, 900, 900}, 256}, {40, 200, 120}), Plane(kWidth, kHeight, 120));
}

TEST(MouthInside, NothingOfItIsThePatternAndAllTheColour) {
  const Plane pattern = noise_plane(kWidth, kHeight, 2);
  EXPECT_EQ(shaded(pattern, {{256, 256, 256}, 0}, {1, 50, 99}), pattern);
  EXPECT_EQ(shaded(pattern, {{256, 256, 256}, 256}, {1, 50, 99}), Plane(kWidth, kHeight, 99));
  const Plane half = shaded(pattern, {{256, 256, 256}, 128}, {1, 50, 99});
  for (std::size_t i = 0; i < pattern.samples.size(); ++i)
    ASSERT_EQ(half.samples[i], (pattern.samples[i] + 99 + 1) / 2);
}

TEST(MouthInside, IsARampOverTheTriangle) {
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
    const RasterTriangle t = in_place(p(), p(), p());
    const Shade shade{{0, 128, 256}, static_cast<std::int32_t>(random() % 257)};
    const Colours colours = {40, 200, 90};
    DepthPlane depth;
    const Plane out = shaded(t, scale, pattern, shade, colours, depth);
    const glm::dvec2 a(t[0].screen), ab = glm::dvec2(t[1].screen) - a, ac = glm::dvec2(t[2].screen) - a;
    const double area = ab.x * ac.y - ab.y * ac.x;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        if (depth.depth[y * kWidth + x] != 0) continue;
        ++compared;
        const glm::dvec2 d = glm::dvec2((x + 0.5) * unit, (y + 0.5) * unit) - a;
        const double ramp = (128 * (d.x * ac.y - d.y * ac.x) + 256 * (ab.x * d.y - ab.y * d.x)) / area;
        const double share = shade.amount / 256.0;
        ASSERT_NEAR(out.row(y)[x], pattern.row(y)[x] * (1 - share) + plain_colour(colours, ramp) * share, 2.5)
            << i;
      }
    }
  }
  EXPECT_GT(compared, 10000);
}

// Slivers, whose gradients are clamped, go beyond what their corners have.
TEST(MouthInside, SliversStayBetweenTheColours) {
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
    const RasterTriangle t = {
        {{centre - along, {}, 0}, {centre + along + side, {}, 0}, {centre + along - side, {}, 0}}};
    DepthPlane depth;
    const Plane out = shaded(t, PlaneScale::kLuma, pattern, {{0, 256, 0}, 256}, {60, 100, 80}, depth);
    for (std::size_t k = 0; k < out.samples.size(); ++k) {
      if (depth.depth[k] != 0) continue;
      ++drawn;
      ASSERT_TRUE(out.samples[k] >= 60 && out.samples[k] <= 100) << static_cast<int>(out.samples[k]);
    }
  }
  EXPECT_GT(drawn, 5000);
}

/// A closed mouth on a face and before a ground of one colour.
Scene even_scene(const MouthInterior& mouth) {
  Picture picture(160, 128);
  picture.y = Plane(160, 128, 230);
  Scene scene = toy_scene(picture);
  scene.setup.mouth = mouth;
  return scene;
}

/// The lower lip hangs so far that all of the inside shows.
State open_mouth() {
  State state = toy_state(80, 56);
  const Feature& inner = feature(FeatureId::kMouthInner);
  for (const int c : {4, 5, 6, 7}) state.control[inner.first_control + c].y = 1200;
  return state;
}

/// Samples of a column of the picture down the middle of the open mouth, a pixel within the lips.
std::vector<int> down_the_mouth(const Scene& scene, const State& state) {
  const Picture out = rendered(scene, state);
  const auto vertices = scene.geometry->project_vertices(state);
  const auto at = [&](std::size_t landmark) { return glm::ivec2(vertices[vertex_of_landmark(landmark)]); };
  const glm::ivec2 top = at(62), bottom = at(66);
  std::vector<int> column;
  for (int y = (top.y + 95) / 64; y * 64 + 96 < bottom.y; ++y) column.push_back(out.y.row(y)[top.x / 64]);
  return column;
}

constexpr YuvColour kGrey{100, 90, 160};

TEST(RendererMouth, ShowsUpperColourAboveAndLowerBelow) {
  const Scene scene = even_scene({{200, 90, 160}, {20, 90, 160}});
  const std::vector<int> column = down_the_mouth(scene, open_mouth());
  ASSERT_GT(column.size(), 6U) << "the case must occur";
  EXPECT_GT(column.front(), 170);
  EXPECT_LT(column.back(), 50);
  EXPECT_TRUE(std::is_sorted(column.rbegin(), column.rend()));
  const Picture out = rendered(scene, open_mouth());
  const auto reddish = [](const Plane& p, std::uint8_t value) {
    return std::count(p.samples.begin(), p.samples.end(), value);
  };
  EXPECT_GT(reddish(out.u, 90), 10);
  EXPECT_EQ(reddish(out.u, 90), reddish(out.v, 160));
}

TEST(RendererMouth, StateAddsAtTheUpperLipHalfWayAndAtTheLowerLip) {
  const Scene scene = even_scene({kGrey, kGrey});
  State state = open_mouth();
  for (const int v : down_the_mouth(scene, state)) EXPECT_EQ(v, 100);
  state.interior = {0, 16 * 60, 0};
  auto column = down_the_mouth(scene, state);
  const auto top = std::max_element(column.begin(), column.end());
  EXPECT_GT(*top, 145);
  EXPECT_LE(*top, 160);
  EXPECT_TRUE(std::is_sorted(column.begin(), top + 1) &&
              std::is_sorted(column.rbegin(), std::reverse_iterator(top)));
  EXPECT_LT(column.front(), 125);
  EXPECT_LT(column.back(), 125);
  state.interior = {16 * 60, 0, 0};
  column = down_the_mouth(scene, state);
  EXPECT_GT(column.front(), 135);
  EXPECT_EQ(column.back(), 100);
  state.interior = {0, 0, -16 * 60};
  column = down_the_mouth(scene, state);
  EXPECT_EQ(column.front(), 100);
  EXPECT_LT(column.back(), 65);
}

// 1/16 grey level, rounded to nearest with halves up; the middle from the mean of both colours.
TEST(RendererMouth, StateIsInSixteenthsAndRounded) {
  const auto even = [](YuvColour upper, YuvColour lower, std::array<std::int32_t, kInteriorCount> inside) {
    State state = open_mouth();
    state.interior = inside;
    const std::vector<int> column = down_the_mouth(even_scene({upper, lower}), state);
    EXPECT_EQ(std::count(column.begin(), column.end(), column[0]),
              static_cast<std::ptrdiff_t>(column.size()));
    return column[0];
  };
  EXPECT_EQ(even(kGrey, kGrey, {7, 7, 7}), 100);
  EXPECT_EQ(even(kGrey, kGrey, {8, 8, 8}), 101);
  EXPECT_EQ(even(kGrey, kGrey, {-8, -8, -8}), 100);
  EXPECT_EQ(even(kGrey, kGrey, {-9, -9, -9}), 99);
  EXPECT_EQ(even({100, 90, 160}, {110, 90, 160}, {16 * 10, 16 * 5, 0}), 110) << "half way is 105";
}

TEST(RendererMouth, StateIsClampedToBlackAndWhite) {
  State state = open_mouth();
  state.interior = {kMaxLight, kMaxLight, kMaxLight};
  for (const int v : down_the_mouth(even_scene({kGrey, kGrey}), state)) EXPECT_EQ(v, 255);
  state.interior = {-kMaxLight, -kMaxLight, -kMaxLight};
  for (const int v : down_the_mouth(even_scene({kGrey, kGrey}), state)) EXPECT_EQ(v, 0);
}

TEST(RendererMouth, StateLeavesChromaAndAllElseAlone) {
  const Scene scene = even_scene({kGrey, kGrey});
  State state = open_mouth();
  const Picture plain = rendered(scene, state);
  state.interior = {-1600, 1600, 1000};
  const Picture changed = rendered(scene, state);
  EXPECT_EQ(changed.u, plain.u);
  EXPECT_EQ(changed.v, plain.v);
  int other = 0;
  for (std::size_t i = 0; i < plain.y.samples.size(); ++i) {
    if (changed.y.samples[i] == plain.y.samples[i]) continue;
    ++other;
    ASSERT_EQ(plain.y.samples[i], kGrey.y) << "only the inside";
  }
  EXPECT_GT(other, 10);
}

TEST(RendererMouth, StateSaysNothingWhileTheLipsAreShut) {
  const Scene scene = even_scene({kGrey, kGrey});
  State state = toy_state(83, 55);
  const Picture plain = rendered(scene, state);
  state.interior = {1600, -1600, 1600};
  EXPECT_EQ(rendered(scene, state), plain);
}

}  // namespace
}  // namespace fbs
