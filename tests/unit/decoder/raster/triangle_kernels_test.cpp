// The kernels against their plain counterparts, on every kind of vector that this machine has.
#include "decoder/raster/triangle_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "common/state.h"
#include "decoder/raster/triangle_kernels_plain.h"
#include "tests/unit/decoder/every_target.h"
#include "tests/unit/decoder/raster/textured_triangle.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr int kWidth = 61, kHeight = 47;

/// Two planes and their depth; luma has the first alone.
struct Drawn {
  std::array<Plane, 2> planes{Plane(kWidth, kHeight, 77), Plane(kWidth, kHeight, 78)};
  DepthPlane depth;

  friend bool operator==(const Drawn& a, const Drawn& b) {
    return a.planes == b.planes && a.depth.depth == b.depth.depth;
  }
};

/// A triangle of a mesh, and what it shows.
struct Shown {
  TexturedTriangle triangle;
  Light light;
  std::vector<LookSource> sources;
};

/// Everything that a mesh is drawn from.
struct Case {
  PlaneScale scale = PlaneScale::kLuma;
  std::array<Plane, 2> textures;
  std::vector<std::array<Plane, 2>> stills;
  LightUse light = LightUse::kNone;
  SampleArea area{0, 0, kWidth, kHeight};
  std::vector<Shown> triangles;

  /// Calls draw(list, shading, depth).
  template <class Draw>
  [[nodiscard]] Drawn by(Draw&& draw) const {
    Drawn out;
    const std::size_t planes = plane_count(scale);
    const std::array<ConstPlaneView, 2> from{textures[0], textures[1]};
    const std::array<PlaneView, 2> to{out.planes[0], out.planes[1]};
    std::vector<ConstPlaneView> still;
    for (const auto& s : stills)
      for (std::size_t p = 0; p < planes; ++p) still.emplace_back(s[p]);
    const Shading shading{std::span(from).first(planes), light, still, std::span(to).first(planes)};
    Rasteriser raster;
    raster.start(scale, area, shading);
    for (const Shown& t : triangles) {
      TriangleLook look = look_of(t.triangle, t.light);
      look.sources = t.sources;
      raster.add(screen_of(t.triangle), look);
    }
    out.depth = raster.depth();
    draw(raster.triangles(), shading, out.depth);
    return out;
  }
  /// Triangles whose numbers fit 32 bits, and others.
  [[nodiscard]] std::array<int, 2> count() const {
    std::array<int, 2> out{};
    (void)by([&](const TriangleList& list, const Shading&, DepthPlane&) {
      for (const DrawnTriangle& t : list.triangles) ++out[t.is_short ? 0 : 1];
    });
    return out;
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
/// another or over its border.
TexturedTriangle random_triangle(std::mt19937& random, const Lie& lie, PlaneScale scale) {
  const int one = 1 << static_cast<int>(scale), radius = one * (random() % 3 == 0 ? 30 : 4);
  const glm::ivec2 centre(within(random, kWidth * one / 2) + kWidth * one / 2,
                          within(random, kHeight * one / 2) + kHeight * one / 2);
  const glm::ivec2 middle = random() % 4 == 0 ? glm::ivec2(random() % 2 * 100 * one, random() % 2 * 100 * one)
                                              : glm::ivec2(50 * one);
  TexturedTriangle t;
  const int depth = within(random, 3000);
  for (TexturedVertex& v : t) {
    const glm::ivec2 at(within(random, radius), within(random, radius));
    const glm::ivec2 noise(within(random, 40), within(random, 40));  // not quite a similarity
    v = {centre + at, middle + lie.of(at) + noise, depth + within(random, 800)};
  }
  if (random() % 20 == 0) t[2].screen = t[1].screen + glm::ivec2(-1, 1);  // a sliver
  if (random() % 20 == 0)
    t[random() % 3].depth = (random() % 2 == 0 ? 1 : -1) * ((1 << 30) + within(random, 9));
  if (random() % 20 == 0) t[0].screen.x -= 1 << 20;
  if (!faces_viewer(screen_of(t))) std::swap(t[1], t[2]);
  return t;
}

Light random_light(std::mt19937& random) {
  const int most = random() % 4 == 0 ? kMaxLight : 700;
  Light out;
  for (auto* corners : {&out.offset, &out.gain})
    for (std::int32_t& v : *corners) v = most > 700 && random() % 2 == 0 ? most : within(random, most);
  return out;
}

/// Some of the sources.
std::vector<LookSource> random_sources(std::mt19937& random, std::size_t stills) {
  std::vector<LookSource> out;
  for (std::size_t s = 0; s <= stills; ++s) {
    if (random() % 3 == 0) continue;
    out.push_back({s, {}});
    for (std::int32_t& w : out.back().weight)
      w = random() % 3 == 0 ? kWeightOne * static_cast<int>(random() % 2)
                            : static_cast<int>(random() % kWeightOne);
  }
  return out;
}

Case random_case(std::mt19937& random, const std::array<Plane, 4>& textures) {
  Case out;
  out.scale = random() % 3 == 0 ? PlaneScale::kChroma : PlaneScale::kLuma;
  const std::size_t size = random() % 2;  // both planes are of one size
  out.textures = {textures[2 * size], textures[2 * size + 1]};
  if (random() % 4 == 0) out.area = {9, 7, 9 + 1 + static_cast<int>(random() % 50), 38};
  if (out.scale == PlaneScale::kLuma) out.light = static_cast<LightUse>(random() % 3);
  for (std::size_t k = random() % 4; k > 0; --k)
    out.stills.push_back({noise_plane(kWidth, kHeight, static_cast<unsigned>(10 + k)),
                          noise_plane(kWidth, kHeight, static_cast<unsigned>(20 + k))});
  for (std::size_t k = 1 + random() % 12; k > 0; --k) {
    Lie lie{uniform(random, 0.5, random() % 2 == 0 ? 1.5 : 4), uniform(random, 0, 6.28)};
    if (random() % 2 == 0) lie.turn = uniform(random, -0.25, 0.25);  // as faces mostly lie
    out.triangles.push_back({random_triangle(random, lie, out.scale), random_light(random),
                             random_sources(random, out.stills.size())});
  }
  return out;
}

/// Noise, and only black and white, where differences are largest.
std::array<Plane, 4> random_textures() {
  std::array<Plane, 4> out{noise_plane(100, 100, 1), noise_plane(100, 100, 2), noise_plane(2, 2, 3),
                           noise_plane(2, 2, 4)};
  for (std::uint8_t& s : out[1].samples) s = s < 128 ? 0 : 255;
  return out;
}

TEST(DrawTriangles, EqualsThePlainOne) {
  const std::array<Plane, 4> textures = random_textures();
  on_every_target([&] {
    std::mt19937 random(1);
    std::array<int, 3> lights{};
    int of_short = 0, of_long = 0, chroma = 0, blended = 0;
    for (int i = 0; i < 1500; ++i) {
      const Case c = random_case(random, textures);
      ASSERT_EQ(c.by(draw_triangles), c.by(plain::draw_triangles)) << i;
      of_short += c.count()[0];
      of_long += c.count()[1];
      ++lights[static_cast<std::size_t>(c.light)];
      blended += c.stills.empty() ? 0 : 1;
      chroma += c.scale == PlaneScale::kChroma ? 1 : 0;
    }
    EXPECT_GT(of_short, 3000);
    EXPECT_GT(of_long, 300);
    EXPECT_GT(blended, 300);
    EXPECT_GT(chroma, 300);
    for (const int count : lights) EXPECT_GT(count, 200);
  });
}

/// Upright, over all of the picture; its texture a hundred samples away.
Case whole_picture(PlaneScale scale) {
  Case out;
  const int one = 1 << static_cast<int>(scale);
  out.scale = scale;
  TexturedTriangle t = in_place({-20 * one, -20 * one}, {140 * one, -20 * one}, {-20 * one, 140 * one});
  for (TexturedVertex& v : t) v.texture += glm::ivec2(100 * one);
  out.triangles = {{t, {}, {}}};
  out.textures = {noise_plane(400, 400, 5), noise_plane(400, 400, 6)};
  return out;
}

// Kernels draw eight samples at once: at the right border only those that exist (address sanitizer).
TEST(DrawTriangles, UpToTheLastSample) {
  on_every_target([] {
    for (const PlaneScale scale : {PlaneScale::kLuma, PlaneScale::kChroma}) {
      Case c = whole_picture(scale);
      for (int right = kWidth - 9; right <= kWidth; ++right) {
        c.area = {kWidth - 20, 3, right, kHeight};
        const Drawn out = c.by(draw_triangles);
        for (int y = 0; y < kHeight; ++y)
          for (int x = 0; x < kWidth; ++x)
            for (std::size_t p = 0; p < plane_count(scale); ++p) {
              const bool inside = x >= kWidth - 20 && x < right && y >= 3;
              ASSERT_EQ(out.planes[p].row(y)[x], inside ? c.textures[p].row(y + 100)[x + 100] : 77 + p)
                  << x << ',' << y << ": " << right;
            }
      }
    }
  });
}

// A mesh that no triangle shows the texture of needs none.
TEST(DrawTriangles, StillSourcesAloneNeedNoTexture) {
  on_every_target([] {
    Case c = whole_picture(PlaneScale::kLuma);
    c.textures = {};
    c.stills = {{noise_plane(kWidth, kHeight, 7), {}}};
    c.triangles[0].sources = {{1, {}}};
    EXPECT_EQ(c.by(draw_triangles).planes[0], c.stills[0][0]);
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
