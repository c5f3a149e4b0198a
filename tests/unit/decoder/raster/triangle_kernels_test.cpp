// The kernel against its plain counterpart and against the rasteriser's own loops, on every kind of vector
// that this machine has.
#include "decoder/raster/triangle_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "common/state.h"
#include "decoder/raster/blend_weights.h"
#include "decoder/raster/triangle_kernels_plain.h"
#include "tests/unit/decoder/every_target.h"
#include "tests/unit/decoder/raster/textured_triangle.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr int kWidth = 61, kHeight = 47;
constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max();

/// Two planes and their depth; luma has the first alone.
struct Drawn {
  std::array<Plane, 2> planes{Plane(kWidth, kHeight, 77), Plane(kWidth, kHeight, 78)};
  DepthPlane depth;

  Drawn() { depth.reset(kWidth, kHeight, {0, 0, kWidth, kHeight}); }
  [[nodiscard]] std::array<PlaneView, 2> views() { return {planes[0], planes[1]}; }
  friend bool operator==(const Drawn& a, const Drawn& b) {
    return a.planes == b.planes && a.depth.depth == b.depth.depth;
  }
};

/// Everything that a triangle is drawn from.
struct Case {
  PlaneScale scale = PlaneScale::kLuma;
  TexturedTriangle triangle;
  std::array<Plane, 2> textures;
  SampleArea area{0, 0, kWidth, kHeight};
  Light light, light_before;
  bool has_light = false, has_light_before = false;
  /// Still sources that are blended with it, and the weights of all but the last.
  std::vector<std::array<Plane, 2>> stills;
  std::array<std::array<std::int32_t, 3>, 2> weights{};
  Drawn before;

  /// Calls draw(sources, target) over earlier content.
  template <class Draw>
  [[nodiscard]] Drawn after(Draw&& draw) const {
    Drawn out = before;
    const std::array<ConstPlaneView, 2> from{textures[0], textures[1]};
    const std::array<PlaneView, 2> to = out.views();
    const std::size_t planes = plane_count(scale);
    Finish finish;
    if (has_light) finish.light = &light;
    if (has_light_before) finish.light_before = &light_before;
    std::vector<TextureSource> sources{source_of(triangle, std::span(from).first(planes), finish)};
    std::vector<std::array<ConstPlaneView, 2>> still_planes;
    for (const auto& still : stills) still_planes.push_back({still[0], still[1]});
    for (const auto& still : still_planes) {
      sources.push_back(source_of(triangle, std::span(still).first(planes)));
      for (std::size_t i = 0; i < 3; ++i) sources.back().corners[i] = triangle[i].screen;
    }
    for (std::size_t k = 0; k + 1 < sources.size(); ++k) sources[k].weight = weights[k];
    draw(std::span<const TextureSource>(sources),
         RasterTarget{scale, std::span(to).first(planes), area, &out.depth});
    return out;
  }

  [[nodiscard]] std::optional<ShortTriangle> shortened() const {
    std::optional<ShortTriangle> out;
    const TriangleSetup setup(screen_of(triangle), scale);
    if (!setup.faces_viewer()) return out;
    (void)after([&](std::span<const TextureSource> sources, const RasterTarget& target) {
      out = shorten(setup, screen_of(triangle), sources, target);
    });
    return out;
  }

  /// @param draw  draw_short_triangle(), or its plain counterpart
  template <class Draw>
  [[nodiscard]] Drawn by(Draw&& draw, const ShortTriangle& t) const {
    return after([&](std::span<const TextureSource> sources, const RasterTarget& target) {
      draw(t, scale, sources, target.planes, *target.depth);
    });
  }

  /// Uses the rasteriser's own loops, which it takes for several moving sources: here the first is repeated
  /// without weight.
  [[nodiscard]] Drawn by_loops() const {
    return after([&](std::span<const TextureSource> sources, const RasterTarget& target) {
      std::vector<TextureSource> more(sources.begin(), sources.end());
      if (more.size() == 1) more[0].weight.fill(kWeightOne);
      more.insert(more.begin() + 1, more[0]);
      more[1].weight.fill(0);
      draw_triangle(screen_of(triangle), more, target);
    });
  }
};

double uniform(std::mt19937& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
}

int within(std::mt19937& random, int most) {
  return static_cast<int>(random() % static_cast<unsigned>(2 * most + 1)) - most;
}

/// How a texture lies on the screen.
struct Lie {
  double texels, turn;  ///< a sample; radians

  [[nodiscard]] glm::ivec2 of(glm::ivec2 on_screen) const {
    const double c = texels * std::cos(turn), s = texels * std::sin(turn);
    return {static_cast<int>(c * on_screen.x - s * on_screen.y),
            static_cast<int>(s * on_screen.x + c * on_screen.y)};
  }
};

/// A triangle about some place of the picture, over its border too, whose texture lies about the middle of
/// another.
TexturedTriangle random_triangle(std::mt19937& random, const Lie& lie, PlaneScale scale) {
  const int one = 1 << static_cast<int>(scale), radius = one * (random() % 4 == 0 ? 3 : 30);
  const glm::ivec2 centre(within(random, kWidth * one / 2) + kWidth * one / 2,
                          within(random, kHeight * one / 2) + kHeight * one / 2);
  const glm::ivec2 middle(200 * one + within(random, one), 200 * one + within(random, one));
  TexturedTriangle t;
  const int depth = within(random, 3000);
  for (TexturedVertex& v : t) {
    const glm::ivec2 at(within(random, radius), within(random, radius));
    const glm::ivec2 noise(within(random, 40), within(random, 40));  // not quite a similarity
    v = {centre + at, middle + lie.of(at) + noise, depth + within(random, 800)};
  }
  if (!faces_viewer(screen_of(t))) std::swap(t[1], t[2]);
  return t;
}

/// Depths near random_triangle()'s, or nothing yet.
void put_depth(std::mt19937& random, DepthPlane& depth) {
  const unsigned kind = random() % 3;
  for (std::int32_t& z : depth.depth)
    if (kind == 1 || (kind == 2 && random() % 2 == 0)) z = within(random, 4000);
}

Light random_light(std::mt19937& random) {
  const int most = random() % 4 == 0 ? kMaxLight - 1 : 700;
  Light out;
  for (auto* corners : {&out.offset, &out.gain})
    for (std::int32_t& v : *corners) v = most > 700 && random() % 2 == 0 ? most : within(random, most);
  return out;
}

Case random_case(std::mt19937& random, const std::array<Plane, 4>& textures) {
  Case out;
  out.scale = random() % 3 == 0 ? PlaneScale::kChroma : PlaneScale::kLuma;
  Lie lie{uniform(random, 0.5, random() % 2 == 0 ? 1.5 : 4), uniform(random, 0, 6.28)};
  if (random() % 2 == 0) lie.turn = uniform(random, -0.25, 0.25);  // as faces mostly lie
  out.triangle = random_triangle(random, lie, out.scale);
  out.textures = {textures[random() % 4], textures[random() % 4]};
  if (random() % 4 == 0) out.area = {9, 7, 9 + 1 + static_cast<int>(random() % 50), 38};
  out.has_light = random() % 2 == 0;
  out.light = random_light(random);
  put_depth(random, out.before.depth);
  if (random() % 3 != 0) return out;
  for (unsigned k = 1 + random() % 2; k > 0; --k)
    out.stills.push_back({noise_plane(kWidth, kHeight, 10 + k), noise_plane(kWidth, kHeight, 20 + k)});
  for (auto& corners : out.weights)
    for (std::int32_t& w : corners)
      w = random() % 3 == 0 ? kWeightOne * static_cast<int>(random() % 2)
                            : static_cast<int>(random() % kWeightOne);
  return out;
}

/// Noise, and only black and white, where differences are largest.
std::array<Plane, 4> random_textures() {
  std::array<Plane, 4> out{noise_plane(400, 400, 1), noise_plane(400, 400, 2), noise_plane(400, 400, 3),
                           noise_plane(400, 400, 4)};
  for (std::uint8_t& s : out[3].samples) s = s < 128 ? 0 : 255;
  return out;
}

/// The lookups that a kernel with this many lanes can choose from: texels that a step reaches over.
struct Lookups {
  int two_rows = 0, four_rows = 0, one_by_one = 0;

  void count(const ShortTriangle& t, int lanes) {
    const double one = 65536.0 / (lanes - 1), across = std::abs(t.u.dx) / one, down = std::abs(t.v.dx) / one;
    ++(across > 13 || down > 3 ? one_by_one : down > 1 ? four_rows : two_rows);
  }
  void expect_each() const {
    EXPECT_GT(two_rows, 50);
    EXPECT_GT(four_rows, 50);
    EXPECT_GT(one_by_one, 50);
  }
};

TEST(TriangleKernels, EqualThePlainOneAndTheLoopsOfTheRasteriser) {
  const std::array<Plane, 4> textures = random_textures();
  on_every_target([&] {
    std::mt19937 random(1);
    Lookups of_four, of_eight;
    int drawn = 0, lit = 0, chroma = 0, blended = 0;
    for (int i = 0; i < 3000; ++i) {
      const Case c = random_case(random, textures);
      const auto t = c.shortened();
      if (!t) continue;
      const Drawn out = c.by(draw_short_triangle, *t);
      ASSERT_EQ(out, c.by(plain::draw_short_triangle, *t)) << i;
      ASSERT_EQ(out, c.by_loops()) << i;
      if (out == c.before) continue;
      ++drawn;
      of_four.count(*t, 4);
      of_eight.count(*t, 8);
      lit += c.has_light ? 1 : 0;
      blended += c.stills.empty() ? 0 : 1;
      chroma += c.scale == PlaneScale::kChroma ? 1 : 0;
    }
    EXPECT_GT(drawn, 1000);
    EXPECT_GT(lit, 300);
    EXPECT_GT(blended, 300);
    EXPECT_GT(chroma, 300);
    of_four.expect_each();
    of_eight.expect_each();
  });
}

// draw_triangle() takes the kernels; its own loops for textures at the border and light that is taken back.
TEST(TriangleKernels, DrawTriangleIsTheSameWithThemAndWithout) {
  const std::array<Plane, 4> textures = random_textures();
  on_every_target([&] {
    std::mt19937 random(2);
    std::array<int, 2> taken{};
    for (int i = 0; i < 1500; ++i) {
      Case c = random_case(random, textures);
      if (i % 2 == 0)
        for (TexturedVertex& v : c.triangle) v.texture -= glm::ivec2(200 << static_cast<int>(c.scale), 0);
      c.has_light_before = i % 7 == 1;
      c.light_before = random_light(random);
      const Drawn out = c.after([&](std::span<const TextureSource> sources, const RasterTarget& target) {
        draw_triangle(screen_of(c.triangle), sources, target);
      });
      ASSERT_EQ(out, c.by_loops()) << i;
      ++taken[c.shortened() ? 1 : 0];
    }
    EXPECT_GT(taken[0], 300);
    EXPECT_GT(taken[1], 300);
  });
}

/// Upright, in its place, over all of the picture.
Case whole_picture(PlaneScale scale) {
  Case out;
  const int one = 1 << static_cast<int>(scale);
  out.scale = scale;
  out.triangle = in_place({-20 * one, -20 * one}, {140 * one, -20 * one}, {-20 * one, 140 * one});
  for (TexturedVertex& v : out.triangle) v.texture += glm::ivec2(100 * one);
  out.textures = {noise_plane(400, 400, 5), noise_plane(400, 400, 6)};
  return out;
}

// Kernels draw eight samples at once: at the right border only those that exist (address sanitizer).
TEST(TriangleKernels, DrawUpToTheLastSample) {
  on_every_target([] {
    for (const PlaneScale scale : {PlaneScale::kLuma, PlaneScale::kChroma}) {
      Case c = whole_picture(scale);
      for (int right = kWidth - 9; right <= kWidth; ++right) {
        c.area = {kWidth - 20, 3, right, kHeight};
        const auto t = c.shortened();
        ASSERT_TRUE(t);
        const Drawn out = c.by(draw_short_triangle, *t);
        for (int y = 0; y < kHeight; ++y)
          for (int x = 0; x < kWidth; ++x)
            for (std::size_t p = 0; p < plane_count(scale); ++p) {
              const bool inside = x >= kWidth - 20 && x < right && y >= 3;
              ASSERT_EQ(out.planes[p].row(y)[x],
                        inside ? c.textures[p].row(y + 100)[x + 100] : c.before.planes[p].row(y)[x])
                  << x << ',' << y << ": " << right;
            }
      }
    }
  });
}

TEST(TriangleKernels, EqualDepthKeepsWhatWasThere) {
  on_every_target([] {
    Case c = whole_picture(PlaneScale::kLuma);
    for (TexturedVertex& v : c.triangle) v.depth = 7;
    for (int x = 0; x < kWidth; ++x) c.before.depth.row(20)[x] = x % 3 == 0 ? 6 : x % 3 == 1 ? 7 : 8;
    const auto t = c.shortened();
    ASSERT_TRUE(t);
    Drawn out = c.by(draw_short_triangle, *t);
    for (int x = 0; x < kWidth; ++x) {
      EXPECT_EQ(out.planes[0].row(20)[x], x % 3 == 2 ? c.textures[0].row(120)[x + 100] : 77) << x;
      EXPECT_EQ(out.depth.row(20)[x], x % 3 == 0 ? 6 : 7) << x;
      EXPECT_EQ(out.depth.row(21)[x], 7);
    }
  });
}

TEST(TriangleKernels, LightFallsOnLumaAlone) {
  on_every_target([] {
    for (const PlaneScale scale : {PlaneScale::kLuma, PlaneScale::kChroma}) {
      Case c = whole_picture(scale);
      c.textures = {Plane(400, 400, 100), Plane(400, 400, 200)};
      c.has_light = true;
      c.light = {{160, 160, 160}, {64, 64, 64}};  // ten levels more, and 1/16 away from the middle
      const auto t = c.shortened();
      ASSERT_TRUE(t);
      const Drawn out = c.by(draw_short_triangle, *t);
      EXPECT_EQ(out.planes[0].row(20)[20], scale == PlaneScale::kLuma ? 108 : 100) << "110 - 28 / 16";
      EXPECT_EQ(out.planes[1].row(20)[20], scale == PlaneScale::kLuma ? 78 : 200);
    }
  });
}

TEST(CountCovered, EqualsThePlainOne) {
  on_every_target([] {
    std::mt19937 random(4);
    DepthPlane depth;
    depth.reset(kWidth, kHeight, {0, 0, kWidth, kHeight});
    for (std::int32_t& z : depth.depth)
      if (random() % 3 == 0) z = within(random, 4000);
    for (int i = 0; i < 300; ++i) {
      const int x = static_cast<int>(random() % kWidth), y = static_cast<int>(random() % kHeight);
      const SampleArea part{x, y, std::min(x + static_cast<int>(random() % 17), kWidth),
                            std::min(y + static_cast<int>(random() % 17), kHeight)};
      ASSERT_EQ(count_covered(depth, part), plain::count_covered(depth, part)) << i;
    }
  });
}

}  // namespace
}  // namespace fbs
