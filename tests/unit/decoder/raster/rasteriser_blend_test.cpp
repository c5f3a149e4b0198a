// Textures blended with still sources.
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

/// A source: the texture first, then still ones.
struct BlendedSource {
  Plane plane;
  std::array<std::int32_t, 3> weight{};
};

/// @param shown  numbers of the sources that the triangle shows; none: the texture alone
Plane blended(const TexturedTriangle& t, const std::vector<BlendedSource>& blend,
              const std::vector<std::size_t>& shown, PlaneScale scale = PlaneScale::kLuma,
              const Light* light = nullptr) {
  Plane target(kWidth, kHeight, 7), other(kWidth, kHeight, 7);
  const std::size_t planes = plane_count(scale);
  std::vector<ConstPlaneView> from;
  for (const BlendedSource& b : blend) from.insert(from.end(), planes, b.plane);
  const std::array<PlaneView, 2> to = {target, other};
  std::vector<LookSource> sources;
  for (const std::size_t s : shown) sources.push_back({s, blend[s].weight});
  TriangleLook look = look_of(t, light == nullptr ? Light{} : *light);
  look.sources = sources;
  Rasteriser raster;
  raster.start(scale, whole(target),
               {std::span(from).first(planes), light == nullptr ? LightUse::kNone : LightUse::kAdded,
                std::span(from).subspan(planes), std::span(to).first(planes)});
  raster.add(screen_of(t), look);
  raster.draw();
  if (scale == PlaneScale::kChroma) {
    EXPECT_EQ(target, other) << "both planes alike";
  }
  return target;
}

/// All sources are shown.
Plane blended(const TexturedTriangle& t, const std::vector<BlendedSource>& blend,
              PlaneScale scale = PlaneScale::kLuma, const Light* light = nullptr) {
  std::vector<std::size_t> all;
  for (std::size_t s = 0; s < blend.size(); ++s) all.push_back(s);
  return blended(t, blend, all, scale, light);
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
  return in_place(place(), place(), place());
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
    EXPECT_EQ(blended(kWhole, {{grey(100), even(1024)}, {grey(200)}}, scale), grey(175));
    EXPECT_EQ(blended(kWhole, {{grey(0), even(2048)}, {grey(255)}}, scale), grey(128)) << "halves go up";
    // Not a multiple of 1/256.
    EXPECT_EQ(blended(kWhole, {{grey(0), even(2049)}, {grey(255)}}, scale), grey(127));
    EXPECT_EQ(blended(kWhole, {{grey(40), even(1365)}, {grey(80), even(1365)}, {grey(240)}}, scale),
              grey(120));
  }
}

TEST(RasteriserBlend, LastSourceTakesWhatTheOthersLeave) {
  const Plane white(kWidth, kHeight, 255), black(kWidth, kHeight, 0);
  EXPECT_EQ(blended(kWhole, {{white, even(0)}, {black, even(0)}}), black);
  EXPECT_EQ(blended(kWhole, {{white, even(kWeightOne)}, {black, even(kWeightOne)}}), white);
  EXPECT_EQ(blended(kWhole, {{white, even(kWeightOne)}, {black, even(99)}, {black, even(55)}}), white)
      << "nothing is left for those behind";
}

TEST(RasteriserBlend, SourcesThatAreNotShownDoNotCount) {
  const auto grey = [](int value) { return Plane(kWidth, kHeight, static_cast<std::uint8_t>(value)); };
  const std::vector<BlendedSource> blend{
      {grey(100), even(1024)}, {grey(200), even(1024)}, {grey(50), even(1024)}, {grey(0), even(1024)}};
  EXPECT_EQ(blended(kWhole, blend, std::vector<std::size_t>{}), grey(100));
  EXPECT_EQ(blended(kWhole, blend, {1}), grey(200));
  EXPECT_EQ(blended(kWhole, blend, {0, 2}), grey(63)) << "62.5";
  EXPECT_EQ(blended(kWhole, blend, {1, 3}), grey(50));
}

// SPEC 11.6: weights are those at the centre of each sample.
TEST(RasteriserBlend, WeightsAreLinearOverTheTriangle) {
  const TexturedTriangle t = in_place({0, 0}, {64 * kWidth, 0}, {0, 64 * kHeight});
  const Plane out =
      blended(t, {{Plane(kWidth, kHeight, 200), {0, kWeightOne, 2048}}, {Plane(kWidth, kHeight, 0)}});
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
    const TexturedTriangle t = random_triangle(random);
    const BlendedSource one{noise_plane(kWidth, kHeight, static_cast<unsigned>(i))};
    std::vector<BlendedSource> blend(2 + random() % 20, one);
    set_weights(random, i % 3 == 0 ? 16 : 1, i % 4 < 2, blend);
    ASSERT_EQ(blended(t, blend, scale), blended(t, {one}, scale)) << i;
  }
}

/// Blends what single sources draw by the format's formula.
Plane plain_blend(const TexturedTriangle& on_screen, const std::vector<BlendedSource>& blend) {
  std::vector<Plane> drawn{blended(on_screen, {blend[0]})};
  for (std::size_t s = 1; s < blend.size(); ++s) drawn.push_back(blend[s].plane);
  Plane out(kWidth, kHeight, 7);
  const TriangleSetup setup(screen_of(on_screen), PlaneScale::kLuma);
  if (!setup.faces_viewer()) return out;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (!covers(on_screen, PlaneScale::kLuma, x, y)) continue;
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

TEST(RasteriserBlend, IsTheFormatsFormula) {
  std::mt19937 random(2);
  for (int i = 0; i < 1200; ++i) {
    std::vector<BlendedSource> blend(2 + random() % 5);
    TexturedTriangle t = random_triangle(random);
    const TexturedTriangle texture = random_triangle(random);
    for (std::size_t k = 0; k < 3; ++k) t[k].texture = texture[k].texture;
    for (BlendedSource& b : blend) b.plane = noise_plane(kWidth, kHeight, static_cast<unsigned>(random()));
    set_weights(random, i % 3 == 0 ? 16 : 1, i % 3 < 2, blend);
    ASSERT_EQ(blended(t, blend), plain_blend(t, blend)) << i;
  }
}

TEST(RasteriserBlend, LightFallsOnTheTextureBeforeTheBlend) {
  const Plane grey(kWidth, kHeight, 100), white(kWidth, kHeight, 250);
  const Light ten{even(160), even(0)}, strong{even(1600), even(0)};
  EXPECT_EQ(blended(kWhole, {{grey, even(1024)}, {grey}}, PlaneScale::kLuma, &ten),
            Plane(kWidth, kHeight, 103))
      << "2.5 levels";
  EXPECT_EQ(blended(kWhole, {{white, even(1024)}, {grey}}, PlaneScale::kLuma, &strong),
            Plane(kWidth, kHeight, 139))
      << "white, not more";
}

// Slivers at the limits of what projection gives: nothing overflows (sanitizers), nothing else is drawn.
TEST(RasteriserBlend, SurvivesHostileTriangles) {
  std::mt19937 random(3);
  constexpr int kMaxPosition = 1 << 21;
  const auto wild = [&] {
    return random() % 2 == 0 ? static_cast<int>(random() % 2048)
                             : static_cast<int>(random() % (2 * kMaxPosition)) - kMaxPosition;
  };
  const Plane grey(kWidth, kHeight, 99);
  for (int i = 0; i < 3000; ++i) {
    std::vector<BlendedSource> blend(3, {grey});
    TexturedTriangle t;
    for (TexturedVertex& v : t) v = {{wild(), wild()}, {wild(), wild()}, 0};
    set_weights(random, 1, false, blend);
    ASSERT_EQ(blended(t, blend), blended(t, {blend[0]})) << i;
  }
}

}  // namespace
}  // namespace fbs
