#include "decoder/raster/rasteriser.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/unit/decoder/raster/textured_triangle.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

using std::int64_t;

constexpr int kMaxPosition = 1 << 21;  ///< of what projection gives

glm::ivec2 random_point(std::mt19937& random, int width, int height, int unit) {
  const auto within = [&](int n) {
    return (static_cast<int>(random() % static_cast<unsigned>(n + 16)) - 8) * unit;
  };
  return {within(width * 64 / unit), within(height * 64 / unit)};
}

TEST(Rasteriser, CoversSamplesByThePlainRule) {
  std::mt19937 random(1);
  const Plane white(24, 20, 255);
  for (int i = 0; i < 3000; ++i) {
    // Every other triangle has its corners on sample centres and borders, so that edges pass through centres.
    const int unit = i % 2 == 0 ? 1 : 32;
    const PlaneScale scale = i % 3 == 0 ? PlaneScale::kChroma : PlaneScale::kLuma;
    const auto p = [&] { return random_point(random, 24, 20, unit); };
    const TexturedTriangle t = in_place(p(), p(), p());
    Plane target(24, 20);
    draw(t, scale, white, target);
    for (int y = 0; y < 20; ++y)
      for (int x = 0; x < 24; ++x)
        ASSERT_EQ(target.row(y)[x] != 0, covers(t, scale, x, y)) << i << ": " << x << ',' << y;
  }
}

TEST(Rasteriser, DrawsOnlyInsideTheArea) {
  std::mt19937 random(2);
  const Plane white(24, 20, 255);
  for (int i = 0; i < 500; ++i) {
    const TexturedTriangle t = in_place(random_point(random, 24, 20, 1), random_point(random, 24, 20, 1),
                                        random_point(random, 24, 20, 1));
    const int x0 = static_cast<int>(random() % 24), y0 = static_cast<int>(random() % 20);
    const SampleArea area{x0, y0, x0 + static_cast<int>(random() % static_cast<unsigned>(25 - x0)),
                          y0 + static_cast<int>(random() % static_cast<unsigned>(21 - y0))};
    Plane target(24, 20);
    const ConstPlaneView from = white;
    const PlaneView to = target;
    draw(t, PlaneScale::kLuma, area, {{&from, 1}, LightUse::kNone, {}, {&to, 1}});
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 24; ++x) {
        const bool in_area = x >= area.x0 && x < area.x1 && y >= area.y0 && y < area.y1;
        ASSERT_EQ(target.row(y)[x] != 0, in_area && covers(t, PlaneScale::kLuma, x, y));
      }
    }
  }
}

TEST(Rasteriser, AnticlockwiseAndFlatTrianglesAreNotDrawn) {
  const Plane white(8, 8, 255);
  Plane target(8, 8);
  draw(in_place({0, 0}, {0, 512}, {512, 0}), PlaneScale::kLuma, white, target);
  draw(in_place({0, 32}, {512, 32}, {256, 32}), PlaneScale::kLuma, white, target);
  draw(in_place({64, 64}, {64, 64}, {64, 64}), PlaneScale::kLuma, white, target);
  EXPECT_EQ(target, Plane(8, 8));
}

// The diagonal passes through the centres of the samples on it: they belong to the triangle to whose left
// edge it is.
TEST(Rasteriser, SampleOnAnEdgeBelongsToTheTopOrLeftTriangle) {
  const Plane white(4, 4, 255);
  Plane upper(4, 4), lower(4, 4);
  draw(in_place({0, 0}, {256, 0}, {256, 256}), PlaneScale::kLuma, white, upper);
  draw(in_place({0, 0}, {256, 256}, {0, 256}), PlaneScale::kLuma, white, lower);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(upper.row(i)[i], 255);
    EXPECT_EQ(lower.row(i)[i], 0);
  }
}

/// How often each sample is drawn by a mesh of triangles.
std::vector<int> times_drawn(const std::vector<TexturedTriangle>& mesh, PlaneScale scale, int width,
                             int height) {
  const Plane one(width, height, 1);
  std::vector<int> times(one.samples.size());
  for (const TexturedTriangle& t : mesh) {
    Plane target(width, height);
    draw(t, scale, one, target);
    for (std::size_t i = 0; i < times.size(); ++i) times[i] += target.samples[i];
  }
  return times;
}

TEST(Rasteriser, SharedEdgesLeaveNoCrackAndDrawNothingTwice) {
  std::mt19937 random(3);
  for (int round = 0; round < 60; ++round) {
    const PlaneScale scale = round % 2 == 0 ? PlaneScale::kLuma : PlaneScale::kChroma;
    const int sample = 1 << static_cast<int>(scale);
    constexpr int kCells = 8, kSamples = 32;
    const int cell = kSamples * sample / kCells;
    // Points move by a fifth of a cell at most, so that no triangle flips; in some rounds by half
    // samples or not at all, so that edges meet in centres.
    const auto jitter = [&] {
      const int unit = round % 3 == 0 ? sample / 2 : 1, reach = round % 5 == 0 ? 0 : cell / unit / 5;
      return (static_cast<int>(random() % static_cast<unsigned>(2 * reach + 1)) - reach) * unit;
    };
    std::vector<glm::ivec2> p;
    for (int r = 0; r <= kCells; ++r)
      for (int c = 0; c <= kCells; ++c) {
        const bool border = r == 0 || c == 0 || r == kCells || c == kCells;
        p.emplace_back(c * cell + (border ? 0 : jitter()), r * cell + (border ? 0 : jitter()));
      }
    std::vector<TexturedTriangle> mesh;
    for (int r = 0; r < kCells; ++r) {
      for (int c = 0; c < kCells; ++c) {
        const auto at = [&](int i, int j) { return p[(r + j) * (kCells + 1) + c + i]; };
        mesh.push_back(in_place(at(0, 0), at(1, 0), at(1, 1)));
        mesh.push_back(in_place(at(0, 0), at(1, 1), at(0, 1)));
      }
    }
    for (const TexturedTriangle& t : mesh) ASSERT_TRUE(faces_viewer(screen_of(t)));
    const auto times = times_drawn(mesh, scale, kSamples, kSamples);
    ASSERT_EQ(std::count(times.begin(), times.end(), 1), kSamples * kSamples) << round;
  }
}

TEST(Rasteriser, FanAboutASampleCentreDrawsItOnce) {
  const glm::ivec2 hub(8 * 64 + 32, 8 * 64 + 32);
  std::vector<TexturedTriangle> fan;
  constexpr int kBlades = 16;
  const auto rim = [&](int i) {
    const double a = 2 * 3.14159265358979 * i / kBlades;
    return hub + glm::ivec2(std::lround(400 * std::cos(a)), std::lround(400 * std::sin(a)));
  };
  for (int i = 0; i < kBlades; ++i) fan.push_back(in_place(hub, rim(i), rim((i + 1) % kBlades)));
  const auto times = times_drawn(fan, PlaneScale::kLuma, 16, 16);
  EXPECT_EQ(times[8 * 16 + 8], 1);
  EXPECT_EQ(*std::max_element(times.begin(), times.end()), 1);
}

TEST(Rasteriser, TextureInItsPlaceReproducesThePatternBitForBit) {
  std::mt19937 random(4);
  const Plane pattern = noise_plane(40, 30, 5);
  for (int i = 0; i < 2000; ++i) {
    const PlaneScale scale = i % 2 == 0 ? PlaneScale::kLuma : PlaneScale::kChroma;
    const int bits = static_cast<int>(scale) - 6;
    const auto p = [&] { return random_point(random, 40 << bits, 30 << bits, 1); };
    const TexturedTriangle t = in_place(p(), p(), p());
    Plane target(40, 30);
    draw(t, scale, pattern, target);
    for (int y = 0; y < 30; ++y)
      for (int x = 0; x < 40; ++x)
        ASSERT_EQ(target.row(y)[x], covers(t, scale, x, y) ? pattern.row(y)[x] : 0) << i;
  }
}

TexturedTriangle shifted_texture(TexturedTriangle t, glm::ivec2 by) {
  for (TexturedVertex& v : t) v.texture += by;
  return t;
}

TEST(Rasteriser, ShiftByWholeSamplesCopies) {
  const Plane pattern = noise_plane(24, 20, 6);
  Plane target(24, 20);
  draw(shifted_texture(kLarge, {3 * 64, -2 * 64}), PlaneScale::kLuma, pattern, target);
  for (int y = 2; y < 20; ++y)
    for (int x = 0; x < 21; ++x) ASSERT_EQ(target.row(y)[x], pattern.row(y - 2)[x + 3]);
}

TEST(Rasteriser, ShiftByHalfASampleAverages) {
  const Plane pattern = noise_plane(24, 20, 7);
  Plane target(24, 20);
  draw(shifted_texture(kLarge, {32, 0}), PlaneScale::kLuma, pattern, target);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 23; ++x)
      ASSERT_EQ(target.row(y)[x], (pattern.row(y)[x] + pattern.row(y)[x + 1] + 1) / 2);
}

TEST(Rasteriser, ReadingOutsideRepeatsTheBorder) {
  const Plane pattern = noise_plane(24, 20, 8);
  Plane target(24, 20);
  draw(shifted_texture(kLarge, {100 * 64, 0}), PlaneScale::kLuma, pattern, target);
  for (int y = 0; y < 20; ++y) ASSERT_EQ(target.row(y)[5], pattern.row(y)[23]);
  draw(shifted_texture(kLarge, {-100 * 64, -100 * 64}), PlaneScale::kLuma, pattern, target);
  EXPECT_EQ(target, Plane(24, 20, pattern.samples.front()));
}

/// Bilinear in doubles at the texture position that belongs to the sample's centre.
double plain_texel(const TexturedTriangle& t, const Plane& pattern, PlaneScale scale, int x, int y) {
  const double unit = 1 << static_cast<int>(scale);
  const auto cross = [](glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; };
  const glm::dvec2 p((x + 0.5) * unit, (y + 0.5) * unit);
  const glm::dvec2 a(t[0].screen), b(t[1].screen), c(t[2].screen);
  const double area = cross(b - a, c - a);
  const double wb = cross(p - a, c - a) / area, wc = cross(b - a, p - a) / area;
  const glm::dvec2 at = glm::dvec2(t[0].texture) * (1 - wb - wc) + glm::dvec2(t[1].texture) * wb +
                        glm::dvec2(t[2].texture) * wc;
  const double u = std::clamp(at.x / unit - 0.5, 0.0, pattern.width - 1.0),
               v = std::clamp(at.y / unit - 0.5, 0.0, pattern.height - 1.0);
  const int i = std::min(static_cast<int>(u), pattern.width - 2),
            j = std::min(static_cast<int>(v), pattern.height - 2);
  const double fu = u - i, fv = v - j;
  const std::uint8_t *top = pattern.row(j), *bottom = pattern.row(j + 1);
  return (top[i] * (1 - fu) + top[i + 1] * fu) * (1 - fv) + (bottom[i] * (1 - fu) + bottom[i + 1] * fu) * fv;
}

/// Grey levels that change by at most 12 from sample to sample, so that 1/256 of a sample is nothing.
Plane wavy_plane(int width, int height) {
  Plane plane(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      plane.row(y)[x] =
          static_cast<std::uint8_t>(128 + 60 * std::sin(x * 0.1) + 60 * std::cos(y * 0.13 + x * 0.05));
  return plane;
}

TEST(Rasteriser, WarpedTextureIsThatOfThePlainRasteriser) {
  std::mt19937 random(9);
  const Plane pattern = wavy_plane(60, 50);
  int compared = 0;
  for (int i = 0; i < 1500; ++i) {
    const PlaneScale scale = i % 2 == 0 ? PlaneScale::kLuma : PlaneScale::kChroma;
    const int bits = static_cast<int>(scale) - 6;
    TexturedTriangle t;
    for (TexturedVertex& v : t)
      v = {random_point(random, 30 << bits, 30 << bits, 1), random_point(random, 60 << bits, 50 << bits, 1),
           0};
    Plane target(30, 30);
    draw(t, scale, pattern, target);
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 30; ++x) {
        if (!covers(t, scale, x, y)) continue;
        ++compared;
        // Slivers squeeze the whole pattern into one sample: there Q16 gradients are the limit.
        ASSERT_NEAR(target.row(y)[x], plain_texel(t, pattern, scale, x, y), 1.01) << i;
      }
    }
  }
  EXPECT_GT(compared, 50000);
}

// Reading with and without a check at the border. The same texture, once at the pattern's border
// and once inside a larger pattern whose margin repeats it.
TEST(Rasteriser, CheckedAndUncheckedReadingAgree) {
  std::mt19937 random(10);
  const Plane pattern = noise_plane(20, 20, 11);
  constexpr int kMargin = 8;
  Plane padded(20 + 2 * kMargin, 20 + 2 * kMargin);
  for (int y = 0; y < padded.height; ++y)
    for (int x = 0; x < padded.width; ++x)
      padded.row(y)[x] = pattern.row(std::clamp(y - kMargin, 0, 19))[std::clamp(x - kMargin, 0, 19)];
  for (int i = 0; i < 1000; ++i) {
    TexturedTriangle t;
    for (TexturedVertex& v : t) v = {random_point(random, 20, 20, 1), random_point(random, 20, 20, 1), 0};
    Plane checked(20, 20), direct(20, 20);
    draw(t, PlaneScale::kLuma, pattern, checked);
    draw(shifted_texture(t, glm::ivec2(kMargin * 64)), PlaneScale::kLuma, padded, direct);
    ASSERT_EQ(checked, direct) << i;
  }
}

// An embedder's memory: rows of a larger buffer, as target and as texture.
TEST(Rasteriser, DrawsIntoPartOfALargerBuffer) {
  std::mt19937 random(18);
  const Plane pattern = noise_plane(24, 20, 19);
  Plane wide_pattern = noise_plane(50, 40, 20);
  const ConstPlaneView from(wide_pattern.row(7) + 9, 24, 20, wide_pattern.width);
  for (int y = 0; y < 20; ++y) std::copy_n(pattern.row(y), 24, wide_pattern.row(y + 7) + 9);
  const Plane untouched = noise_plane(60, 30, 21);
  for (int i = 0; i < 300; ++i) {
    TexturedTriangle t;
    for (TexturedVertex& v : t)
      v = {random_point(random, 24, 20, 1), random_point(random, 24, 20, 1), static_cast<int>(random() % 99)};
    Plane expected(24, 20, 77), buffer = untouched;
    const PlaneView to(buffer.row(5) + 30, 24, 20, buffer.width);
    for (int y = 0; y < 20; ++y) std::fill_n(to.row(y), 24, std::uint8_t{77});
    draw(t, PlaneScale::kLuma, pattern, expected);
    draw(t, PlaneScale::kLuma, whole(expected), {{&from, 1}, LightUse::kNone, {}, {&to, 1}});
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 60; ++x) {
        const bool inside = x >= 30 && x < 54 && y >= 5 && y < 25;
        ASSERT_EQ(buffer.row(y)[x], inside ? expected.row(y - 5)[x - 30] : untouched.row(y)[x])
            << i << ": " << x << ',' << y;
      }
    }
  }
}

TEST(Rasteriser, DrawsAllPlanesAlike) {
  const Plane pattern = noise_plane(24, 20, 12), inverse = noise_plane(24, 20, 13);
  Plane a(24, 20), b(24, 20), alone(24, 20);
  const std::array<ConstPlaneView, 2> from = {pattern, inverse};
  const std::array<PlaneView, 2> to = {a, b};
  const auto t = shifted_texture(kLarge, {77, -40});
  draw(t, PlaneScale::kChroma, whole(a), {from, LightUse::kNone, {}, to});
  draw(t, PlaneScale::kChroma, pattern, alone);
  EXPECT_EQ(a, alone);
  Plane alone_b(24, 20);
  draw(t, PlaneScale::kChroma, inverse, alone_b);
  EXPECT_EQ(b, alone_b);
}

// Positions at the limits of what projection gives and depths at the limits of their type. What counts is
// that nothing overflows (sanitizers) and that coverage stays exact.
TEST(Rasteriser, HostileCoordinatesStayExact) {
  std::mt19937 random(14);
  const Plane pattern = noise_plane(32, 24, 15);
  const auto wild = [&] {
    switch (random() % 4) {
      case 0:
        return kMaxPosition;
      case 1:
        return -kMaxPosition;
      case 2:
        return static_cast<int>(random() % 2048);
      default:
        return static_cast<int>(random() % (2 * kMaxPosition)) - kMaxPosition;
    }
  };
  for (int i = 0; i < 4000; ++i) {
    TexturedTriangle t;
    for (TexturedVertex& v : t) {
      v = {{wild(), wild()}, {wild(), wild()}, static_cast<std::int32_t>(random())};
      if (random() % 3 == 0)
        v.depth = random() % 2 == 0 ? std::numeric_limits<std::int32_t>::max()
                                    : std::numeric_limits<std::int32_t>::min();
    }
    const PlaneScale scale = i % 2 == 0 ? PlaneScale::kLuma : PlaneScale::kChroma;
    const Plane white(32, 24, 255);
    Plane covered(32, 24), drawn(32, 24);
    draw(t, scale, white, covered);
    draw(t, scale, pattern, drawn);
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 32; ++x) ASSERT_EQ(covered.row(y)[x] != 0, covers(t, scale, x, y)) << i;
  }
}

// A triangle that is thinner than a unit may still hold a sample's centre; its gradients are as large as they
// get.
TEST(Rasteriser, SliversReadInsideThePattern) {
  std::mt19937 random(16);
  const Plane pattern = noise_plane(8192, 4, 17);
  int drawn = 0;
  for (int i = 0; i < 4000; ++i) {
    const int x = static_cast<int>(random() % 64) * 64 + 30,
              far = kMaxPosition - static_cast<int>(random() % 1000);
    TexturedTriangle t;
    t[0].screen = {x, -far};
    t[1].screen = {x + 1 + static_cast<int>(random() % 6), far};
    t[2].screen = {x, far};
    for (TexturedVertex& v : t)
      v.texture = {static_cast<int>(random() % (8190 * 64)), static_cast<int>(random() % 256)};
    Plane target(64, 48);
    draw(t, PlaneScale::kLuma, pattern, target);
    drawn += static_cast<int>(
        std::count_if(target.samples.begin(), target.samples.end(), [](auto s) { return s != 0; }));
  }
  EXPECT_GT(drawn, 50000);
}

}  // namespace
}  // namespace fbs
