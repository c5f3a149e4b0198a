// draw_triangle with several sources.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "decoder/raster/rasteriser.h"
#include "tests/unit/decoder/raster/textured_triangle.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr int kWidth = 40, kHeight = 30;

/// A source in one plane; as chroma the same in two.
struct BlendedSource {
  TexturedTriangle triangle;
  Plane texture;
  std::array<std::int32_t, 3> weight{};
  Finish finish{};
};

Plane blended(const std::vector<BlendedSource>& blend, PlaneScale scale = PlaneScale::kLuma,
              DepthPlane* depth = nullptr) {
  Plane target(kWidth, kHeight, 7), other(kWidth, kHeight, 7);
  std::vector<std::array<ConstPlaneView, 2>> from;
  for (const BlendedSource& b : blend) from.push_back({b.texture, b.texture});
  std::vector<TextureSource> sources;
  for (std::size_t i = 0; i < blend.size(); ++i) {
    sources.push_back(
        source_of(blend[i].triangle, std::span(from[i]).first(plane_count(scale)), blend[i].finish));
    sources.back().weight = blend[i].weight;
  }
  const std::array<PlaneView, 2> to = {target, other};
  draw_triangle(screen_of(blend.front().triangle), sources,
                {scale, std::span(to).first(plane_count(scale)), whole(target), depth});
  if (scale == PlaneScale::kChroma) {
    EXPECT_EQ(target, other) << "both planes alike";
  }
  return target;
}

std::array<std::int32_t, 3> even(std::int32_t weight) {
  return {weight, weight, weight};
}

const TexturedTriangle kWhole = in_place({-640, -640}, {10000, -640}, {-640, 10000});

TexturedTriangle random_triangle(std::mt19937& random) {
  const auto place = [&] {
    return glm::ivec2(static_cast<int>(random() % (64 * (kWidth + 16))) - 512,
                      static_cast<int>(random() % (64 * (kHeight + 16))) - 512);
  };
  TexturedTriangle t = in_place(place(), place(), place());
  for (TexturedVertex& v : t)
    v.texture += glm::ivec2(static_cast<int>(random() % 200) - 100, static_cast<int>(random() % 200) - 100);
  return t;
}

/// Weights that sum to at most kWeightOne at each corner, in steps of `unit`.
void set_weights(std::mt19937& random, std::int32_t unit, bool constant, std::vector<BlendedSource>& blend) {
  std::array<std::int32_t, 3> left = even(kWeightOne / unit);
  for (std::size_t s = 0; s + 1 < blend.size(); ++s)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto some = static_cast<std::int32_t>(random() % static_cast<unsigned>(left[i] + 1));
      blend[s].weight[i] = constant && i > 0 ? blend[s].weight[0] : some * unit;
      left[i] -= blend[s].weight[i] / unit;
    }
}

TEST(RasteriserBlend, ConstantTexturesBlendToTheirWeightedMean) {
  const auto grey = [](int value) { return Plane(kWidth, kHeight, static_cast<std::uint8_t>(value)); };
  for (const PlaneScale scale : {PlaneScale::kLuma, PlaneScale::kChroma}) {
    EXPECT_EQ(blended({{kWhole, grey(100), even(1024)}, {kWhole, grey(200)}}, scale), grey(175));
    EXPECT_EQ(blended({{kWhole, grey(0), even(2048)}, {kWhole, grey(255)}}, scale), grey(128))
        << "halves go up";
    // Not a multiple of 1/256.
    EXPECT_EQ(blended({{kWhole, grey(0), even(2049)}, {kWhole, grey(255)}}, scale), grey(127));
    EXPECT_EQ(
        blended({{kWhole, grey(40), even(1365)}, {kWhole, grey(80), even(1365)}, {kWhole, grey(240)}}, scale),
        grey(120));
  }
}

TEST(RasteriserBlend, LastSourceTakesWhatTheOthersLeave) {
  const Plane white(kWidth, kHeight, 255), black(kWidth, kHeight, 0);
  EXPECT_EQ(blended({{kWhole, white, even(0)}, {kWhole, black, even(0)}}), black);
  EXPECT_EQ(blended({{kWhole, white, even(kWeightOne)}, {kWhole, black, even(kWeightOne)}}), white);
  EXPECT_EQ(
      blended({{kWhole, white, even(kWeightOne)}, {kWhole, black, even(99)}, {kWhole, black, even(55)}}),
      white)
      << "nothing is left for those behind";
}

// SPEC 11.6: weights are those at the centre of each sample.
TEST(RasteriserBlend, WeightsAreLinearOverTheTriangle) {
  const TexturedTriangle t = in_place({0, 0}, {64 * kWidth, 0}, {0, 64 * kHeight});
  const Plane out =
      blended({{t, Plane(kWidth, kHeight, 200), {0, kWeightOne, 2048}}, {t, Plane(kWidth, kHeight, 0)}});
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (!covers(t, PlaneScale::kLuma, x, y)) continue;
      const double weight = (x + 0.5) / kWidth + (y + 0.5) / kHeight / 2;
      ASSERT_NEAR(out.row(y)[x], 200 * weight, 0.6) << x << ',' << y;
    }
  }
}

// Whatever the weights: they sum to one everywhere.
TEST(RasteriserBlend, SourcesThatAgreeGiveThePlainPicture) {
  std::mt19937 random(1);
  for (int i = 0; i < 1500; ++i) {
    const PlaneScale scale = i % 2 == 0 ? PlaneScale::kLuma : PlaneScale::kChroma;
    const BlendedSource one{random_triangle(random), noise_plane(kWidth, kHeight, static_cast<unsigned>(i))};
    std::vector<BlendedSource> blend(2 + random() % 20, one);
    set_weights(random, i % 3 == 0 ? kCoarseStep : 1, i % 4 < 2, blend);
    ASSERT_EQ(blended(blend, scale), blended({one}, scale)) << i;
  }
}

/// Blends what single sources draw by the format's formula.
Plane plain_blend(const std::vector<BlendedSource>& blend) {
  std::vector<Plane> drawn;
  for (const BlendedSource& b : blend) drawn.push_back(blended({b}));
  Plane out(kWidth, kHeight, 7);
  const ScreenTriangle t = screen_of(blend.front().triangle);
  const TriangleSetup setup(t, PlaneScale::kLuma);
  if (!setup.faces_viewer()) return out;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (!covers(blend.front().triangle, PlaneScale::kLuma, x, y)) continue;
      std::int64_t left = kWeightOne, sum = kWeightOne / 2;
      for (std::size_t s = 0; s < blend.size(); ++s) {
        const Gradient g = setup.gradient(blend[s].weight, 0);
        const std::int64_t at = g.at(setup.from_corner(x, y), setup.position_bits()) >> 16;
        const std::int64_t weight = s + 1 == blend.size() ? left : std::clamp<std::int64_t>(at, 0, left);
        left -= weight;
        sum += weight * drawn[s].row(y)[x];
      }
      out.row(y)[x] = static_cast<std::uint8_t>(sum >> kWeightOneLog2);
    }
  }
  return out;
}

// Constant weights in 1/256 and in 1/4096, and linear ones: each has a path of its own.
TEST(RasteriserBlend, IsTheFormatsFormula) {
  std::mt19937 random(2);
  for (int i = 0; i < 1200; ++i) {
    std::vector<BlendedSource> blend(2 + random() % 5);
    const TexturedTriangle first = random_triangle(random);
    for (BlendedSource& b : blend) {
      b.triangle = random_triangle(random);
      for (std::size_t k = 0; k < 3; ++k) b.triangle[k].screen = first[k].screen;
      if (random() % 4 == 0)
        for (std::size_t k = 0; k < 3; ++k) b.triangle[k].texture = first[k].screen;  // in its place
      b.texture = noise_plane(kWidth, kHeight, static_cast<unsigned>(random()));
    }
    set_weights(random, i % 3 == 0 ? kCoarseStep : 1, i % 3 < 2, blend);
    ASSERT_EQ(blended(blend), plain_blend(blend)) << i;
  }
}

TEST(RasteriserBlend, LightFallsOnItsSourceBeforeTheBlend) {
  const Plane grey(kWidth, kHeight, 100);
  const Light light{even(160), even(0)};  // ten levels
  const Plane out = blended({{kWhole, grey, even(1024), {.light = &light}}, {kWhole, grey}});
  EXPECT_EQ(out, Plane(kWidth, kHeight, 103)) << "2.5 levels";
}

TEST(RasteriserBlend, KeepsToTheNearestTriangle) {
  TexturedTriangle near_one = in_place({300, 200}, {1000, 300}, {500, 900}), far_one = kWhole;
  for (TexturedVertex& v : far_one) v.depth = 10;
  const Plane white(kWidth, kHeight, 250), grey(kWidth, kHeight, 150), black(kWidth, kHeight, 50);
  DepthPlane depth;
  depth.reset(kWidth, kHeight, whole(white));
  EXPECT_EQ(blended({{near_one, white, even(2048)}, {near_one, black}}, PlaneScale::kLuma, &depth),
            blended({{near_one, grey}}));
  const Plane behind = blended({{far_one, white, even(2048)}, {far_one, black}}, PlaneScale::kLuma, &depth);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      ASSERT_EQ(behind.row(y)[x], covers(near_one, PlaneScale::kLuma, x, y) ? 7 : 150);
}

// Blends of slivers at the limits of what projection gives: nothing overflows (sanitizers), nothing else is
// drawn.
TEST(RasteriserBlend, SurvivesHostileTriangles) {
  std::mt19937 random(3);
  constexpr int kMaxPosition = 1 << 21;
  const auto wild = [&] {
    return random() % 2 == 0 ? static_cast<int>(random() % 2048)
                             : static_cast<int>(random() % (2 * kMaxPosition)) - kMaxPosition;
  };
  for (int i = 0; i < 3000; ++i) {
    std::vector<BlendedSource> blend(3, {{}, noise_plane(kWidth, kHeight, 4)});
    TexturedTriangle t;
    for (TexturedVertex& v : t) v = {{wild(), wild()}, {wild(), wild()}, 0};
    for (BlendedSource& b : blend) b.triangle = t;
    set_weights(random, 1, false, blend);
    ASSERT_EQ(blended(blend), blended({blend[0]})) << i;
  }
}

}  // namespace
}  // namespace fbs
