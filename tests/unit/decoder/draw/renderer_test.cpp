#include "decoder/draw/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tests/unit/decoder/head_area.h"

namespace fbs {
namespace {

constexpr Closeness kOnceMoreSampled{2, 24}, kSoftenedToo{2, 64};

TEST(Renderer, StateOfThePatternReproducesIt) {
  for (const auto& [w, h] : {std::pair{160, 128}, {161, 127}, {64, 64}, {97, 200}}) {
    SCOPED_TRACE(w);
    const Scene scene = toy_scene(smooth_picture(w, h, 1), even_surround(9, 7, kFollowOne));
    expect_shows(rendered(scene, toy_state()), scene.patterns[0].picture, head_area(scene, toy_state()),
                 kOnceMoreSampled);
  }
}

TEST(Renderer, StateOfThePatternReproducesItWhateverThePoseWas) {
  std::mt19937 random(2);
  Picture out;
  Renderer renderer;
  for (int i = 0; i < 40; ++i) {
    State seen = toy_state();
    for (const int k : {kPitch, kYaw, kRoll}) seen.pose[k] = static_cast<int>(random() % 12000) - 6000;
    for (glm::ivec2& c : seen.control)
      c = {static_cast<int>(random() % 801) - 400, static_cast<int>(random() % 801) - 400};
    Scene scene;
    scene.setup = toy_setup();
    scene.geometry.emplace(scene.setup, toy_geometry(), even_surround(6, 6, 3), seen);
    scene.patterns.push_back(make_pattern(smooth_picture(160, 128, 3), seen, scene.geometry));
    ASSERT_TRUE(renderer.render(scene, seen, out));
    SCOPED_TRACE(i);
    expect_shows(out, scene.patterns[0].picture, head_area(scene, seen), kSoftenedToo);
  }
}

/// A scene whose only pattern was seen in another state than the rest state.
Scene scene_seen_in(const State& seen, Picture picture, SurroundMap surround,
                    const State& rest = toy_state()) {
  Scene scene;
  scene.setup = toy_setup(picture.width(), picture.height());
  scene.geometry.emplace(scene.setup, toy_geometry(), std::move(surround), rest);
  scene.patterns.push_back(make_pattern(std::move(picture), seen, scene.geometry));
  return scene;
}

// Nothing has moved since the pattern was seen, so the surround is exact and the head is drawn in place,
// whatever the state was and wherever the rest state has the grid.
TEST(Renderer, SeenStateOfAnyPatternReproducesTheSurroundExactly) {
  std::mt19937 random(12);
  for (int i = 0; i < 60; ++i) {
    const State seen = random_state(random);
    const Scene scene = scene_seen_in(seen, noise_picture(160, 128, 13),
                                      even_surround(6, 6, static_cast<int>(random() % 5), i % 5));
    SCOPED_TRACE(i);
    expect_shows(rendered(scene, seen), scene.patterns[0].picture, head_area(scene, seen), {255, 255});
  }
}

/// The head far outside the picture, body and ground displaced.
State ground_at(int x, int y) {
  State state = toy_state(-5000, 50);
  state.ground = state.body = {64 * x, 64 * y, 0, 0};
  return state;
}

// What counts is the displacement since the pattern was seen, not since rest.
TEST(Renderer, GroundIsDisplacedFromWhereThePatternSawIt) {
  const Picture picture = noise_picture(160, 128, 14);
  const Scene scene = scene_seen_in(ground_at(6, -4), picture, even_surround(8, 6, 0), ground_at(0, 0));
  const Picture out = rendered(scene, ground_at(10, 2));
  for (int y = 16; y < 112; ++y)
    for (int x = 16; x < 144; ++x) ASSERT_EQ(out.y.row(y)[x], picture.y.row(y - 6)[x - 4]) << x << ',' << y;
  for (int y = 8; y < 56; ++y)
    for (int x = 8; x < 72; ++x) ASSERT_EQ(out.u.row(y)[x], picture.u.row(y - 3)[x - 2]) << x << ',' << y;
}

// At rest, but not where the pattern saw it: no cell is still.
TEST(Renderer, CellsAreStillWhereThePatternSawThemAndNotWhereTheyRest) {
  const Picture picture = noise_picture(160, 128, 15);
  const Scene scene = scene_seen_in(ground_at(5, 0), picture, even_surround(8, 6, 0), ground_at(0, 0));
  const Picture out = rendered(scene, ground_at(0, 0));
  for (int y = 8; y < 120; ++y)
    for (int x = 8; x < 144; ++x) ASSERT_EQ(out.y.row(y)[x], picture.y.row(y)[x + 5]) << x << ',' << y;
  EXPECT_EQ(rendered(scene, ground_at(5, 0)), picture);
}

// A pattern drawn from another pattern, drawn back.
TEST(Renderer, PatternSeenElsewhereGivesBackTheFirstOne) {
  Picture smooth(160, 128);
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 160; ++x)
      smooth.y.row(y)[x] = static_cast<std::uint8_t>(128 + 50 * std::sin(x * 0.15) + 50 * std::cos(y * 0.12));
  State other = toy_state(84, 53);
  other.pose[kYaw] = 800;
  other.pose[kRoll] = 500;
  other.light = {16 * 12, 0, 16 * 5, 0};
  const Scene first = toy_scene(smooth, even_surround(10, 8, 2));
  const Scene second = scene_seen_in(other, rendered(first, other), even_surround(10, 8, 2));
  const Picture back = rendered(second, toy_state());
  double worst = 0, sum = 0;
  int count = 0;
  for (int y = 24; y < 104; ++y) {
    for (int x = 40; x < 120; ++x) {
      const double d = std::abs(back.y.row(y)[x] - smooth.y.row(y)[x]);
      worst = std::max(worst, d);
      sum += d;
      ++count;
    }
  }
  EXPECT_LT(sum / count, 1.0);
  EXPECT_LT(worst, 40) << "at edges that hid what lay behind";
}

TEST(Renderer, SceneWithoutPatternsIsAnError) {
  Scene scene = toy_scene(noise_picture(160, 128, 16));
  scene.patterns.clear();
  Renderer renderer;
  Picture out(12, 10);
  const auto drawn = renderer.render(scene, toy_state(), out);
  ASSERT_FALSE(drawn);
  EXPECT_EQ(drawn.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(out, Picture(12, 10));
  EXPECT_FALSE(renderer.render(Scene{}, toy_state(), out));
}

TEST(Renderer, PatternOfAnotherGeometryIsAnError) {
  Scene scene = toy_scene(noise_picture(160, 128, 17), even_surround(9, 7, 1));
  scene.geometry.emplace(scene.setup, toy_geometry(), even_surround(8, 7, 1), toy_state());
  Renderer renderer;
  Picture out;
  EXPECT_EQ(renderer.render(scene, toy_state(), out).error().code, ErrorCode::kInvalidArgument);
  Pattern bare = scene.patterns[0];
  bare.texture = {};
  scene.patterns.replace(0, std::move(bare));
  EXPECT_EQ(renderer.render(scene, toy_state(), out).error().code, ErrorCode::kInvalidArgument);
  scene.set_geometry(*scene.geometry);
  EXPECT_TRUE(renderer.render(scene, toy_state(), out));
}

TEST(Renderer, DrawsIntoTheCallersMemory) {
  const Scene scene = toy_scene(noise_picture(161, 127, 18), even_surround(8, 8, 2));
  State state = toy_state(70, 60);
  state.pose[kYaw] = 3000;
  state.ground = {300, 200, 0, 0};
  const Picture expected = rendered(scene, state);
  Picture buffer(400, 300);
  const auto part = [](Plane& p, const Plane& size) {
    return PlaneView(p.row(11) + 7, size.width, size.height, p.width);
  };
  const PictureView out(part(buffer.y, expected.y), part(buffer.u, expected.u), part(buffer.v, expected.v));
  Renderer renderer;
  ASSERT_TRUE(renderer.render(scene, state, out));
  const auto equals = [](const PlaneView& drawn, const Plane& plane) {
    for (int y = 0; y < plane.height; ++y)
      if (!std::equal(plane.row(y), plane.row(y) + plane.width, drawn.row(y))) return false;
    return true;
  };
  EXPECT_TRUE(equals(out.y, expected.y) && equals(out.u, expected.u) && equals(out.v, expected.v));
  // Nothing beside it has been touched.
  for (int y = 0; y < 127; ++y) std::fill_n(out.y.row(y), 161, std::uint8_t{0});
  EXPECT_EQ(buffer.y, Plane(400, 300));

  const PictureView narrow(PlaneView(out.y.data, 160, 127, 400), out.u, out.v);
  EXPECT_EQ(renderer.render(scene, state, narrow).error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(renderer.render(scene, state, PictureView()).error().code, ErrorCode::kInvalidArgument);
}

TEST(Renderer, SceneWithoutGeometryShowsItsPatternAsItIs) {
  Scene scene;
  scene.setup = toy_setup();
  scene.patterns.push_back(make_pattern(noise_picture(160, 128, 4), {}, scene.geometry));
  EXPECT_EQ(rendered(scene, toy_state(12, 100)), scene.patterns[0].picture);
}

TEST(Renderer, DependsOnItsArgumentsAlone) {
  const Scene scene = toy_scene(noise_picture(160, 128, 5), even_surround(8, 8, 2));
  State rotated = toy_state(70, 60);
  rotated.pose[kYaw] = 3000;
  Renderer renderer;
  Picture first, other(33, 44), again;
  ASSERT_TRUE(renderer.render(scene, rotated, first));
  ASSERT_TRUE(renderer.render(scene, toy_state(), other));
  ASSERT_TRUE(renderer.render(scene, rotated, again));
  EXPECT_EQ(first, again);
  EXPECT_NE(first, other);
  EXPECT_EQ(other.width(), 160);
}

std::vector<glm::ivec2> outline_of(const ScreenMesh& mesh) {
  std::vector<glm::ivec2> out;
  for (const std::uint16_t v : generic_head().outline) out.emplace_back(mesh.head[v]);
  return out;
}

/// Positions of a ScreenMesh or a TextureMesh.
template <class Mesh>
std::vector<glm::ivec2> ring_of(const Mesh& mesh) {
  return {mesh.head.begin() + kVertexCount, mesh.head.end()};
}

/// Bright where head and ring are in toy_state() and `reach` pixels around them, dark elsewhere.
Picture bright_head(int reach) {
  const auto ring = ring_of(toy_scene(Picture(160, 128)).patterns[0].texture);
  Picture out(160, 128);
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 160; ++x) {
      bool head = false;
      for (int dy = -reach; dy <= reach && !head; ++dy)
        for (int dx = -reach; dx <= reach && !head; ++dx) head = winding(ring, x + dx, y + dy) != 0;
      out.y.row(y)[x] = head ? 220 : 30;
    }
  }
  return out;
}

State random_pose(std::mt19937& random) {
  State state = toy_state(60 + static_cast<int>(random() % 40), 38 + static_cast<int>(random() % 30));
  state.pose[kPitch] = static_cast<int>(random() % 4000) - 2000;
  state.pose[kYaw] = static_cast<int>(random() % 6000) - 3000;
  state.pose[kRoll] = static_cast<int>(random() % 6000) - 3000;
  state.pose[kLogScale] += static_cast<int>(random() % 3000) - 1500;
  return state;
}

// Outline and ring close the mesh: wherever such a polygon winds around a sample, some triangle there faces
// the viewer, and its colour comes from the head. A crack would show the dark ground.
TEST(Renderer, MovedHeadShowsNoUncoveredPixel) {
  std::mt19937 random(6);
  const Picture bright = bright_head(2);
  for (int i = 0; i < 60; ++i) {
    const Scene scene = toy_scene(bright, even_surround(20, 16, i % 2 == 0 ? 0 : kFollowOne));
    const State state = random_pose(random);
    const Picture out = rendered(scene, state);
    const ScreenMesh now = scene.geometry->screen_mesh(state);
    const auto outline = outline_of(now), ring = ring_of(now);
    Plane beside(160, 128, 0);
    for (int y = 0; y < 128; ++y)
      for (int x = 0; x < 160; ++x)
        if (winding(outline, x, y) < 1 && winding(ring, x, y) < 1) mark_round(beside, x, y, kSoftenedBand);
    int inside = 0;
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 160; ++x) {
        if (beside.row(y)[x] != 0) continue;
        ++inside;
        ASSERT_EQ(out.y.row(y)[x], 220) << "picture " << i << " at " << x << ',' << y;
      }
    }
    EXPECT_GT(inside, 2000);
  }
}

TEST(Renderer, StillGroundStaysWhereTheHeadIsNot) {
  const Scene scene = toy_scene(noise_picture(160, 128, 7));
  std::mt19937 random(7);
  for (int i = 0; i < 4; ++i) {
    const State state = random_pose(random);
    const Picture out = rendered(scene, state);
    const Plane shown = head_area(scene, state);
    int compared = 0;
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 160; ++x) {
        if (shown.row(y)[x] != 0) continue;
        ++compared;
        ASSERT_EQ(out.y.row(y)[x], scene.patterns[0].picture.y.row(y)[x]);
      }
    }
    EXPECT_GT(compared, 5000);
  }
}

TEST(Renderer, SurroundThatFollowsMovesWithTheHead) {
  const Scene scene = toy_scene(smooth_picture(160, 128, 8), even_surround(32, 32, kFollowOne));
  const State state = toy_state(84, 48);  // 4 pixels right, 2 up
  const Picture out = rendered(scene, state);
  const auto part = [](const Plane& from, int x0, int y0, int width, int height) {
    Plane taken(width, height);
    for (int y = 0; y < height; ++y) std::copy_n(from.row(y0 + y) + x0, width, taken.row(y));
    return taken;
  };
  const Picture& pattern = scene.patterns[0].picture;
  const Plane shown =
      part(head_area(scene, state), 24, 16, 112, 96);  // patches that the border does not reach
  expect_shows(part(out.y, 24, 16, 112, 96), part(pattern.y, 20, 18, 112, 96), shown, kOnceMoreSampled);
  expect_shows(part(out.u, 12, 8, 56, 48), part(pattern.u, 10, 9, 56, 48), shown, kOnceMoreSampled);
  expect_shows(part(out.v, 12, 8, 56, 48), part(pattern.v, 10, 9, 56, 48), shown, kOnceMoreSampled);
}

// The outermost samples of many videos are dark: content that comes in from outside repeats samples within.
TEST(Renderer, DarkBorderIsNotRepeated) {
  Picture picture(160, 128);
  picture.y = Plane(160, 128, 200);
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 160; ++x)
      if (x == 0 || y == 0 || x == 159 || y == 127) picture.y.row(y)[x] = 10;
  const Scene scene = toy_scene(picture);
  EXPECT_EQ(rendered(scene, toy_state()), picture) << "where nothing moves it is as it was";
  for (const glm::ivec2 by : {glm::ivec2(10, 7), {-13, -4}, {40, -30}}) {
    State state = toy_state();
    state.ground = {64 * by.x, 64 * by.y, 0, 0};
    EXPECT_EQ(rendered(scene, state).y, Plane(160, 128, 200)) << by.x;
  }
}

// Every sample of the head by the depth of every triangle there: slow, and without a depth buffer.
TEST(Renderer, ShowsTheNearestTriangle) {
  Picture ramp(160, 128);
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 160; ++x) ramp.y.row(y)[x] = static_cast<std::uint8_t>(x + y / 2);
  const Scene scene = toy_scene(ramp);
  State state = toy_state();
  state.pose[kYaw] = 7000;  // 38 degrees: the nose hides a cheek
  const Picture out = rendered(scene, state);
  const ScreenMesh now = scene.geometry->screen_mesh(state);
  const TextureMesh& seen = scene.patterns[0].texture;
  int compared = 0, hidden = 0, softened = 0;
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 160; ++x) {
      const glm::dvec2 p(x * 64 + 32, y * 64 + 32);
      double nearest = 1e18, grey = 0;
      int layers = 0;
      bool on_edge = false;
      for (const auto& t : generic_head_mesh().triangles) {
        const auto corner = [&](const auto& mesh, std::size_t i) { return mesh.head[t[i]]; };
        const glm::dvec2 a(corner(now, 0)), b(corner(now, 1)), c(corner(now, 2));
        const auto cross = [](glm::dvec2 u, glm::dvec2 v) { return u.x * v.y - u.y * v.x; };
        const double area = cross(b - a, c - a);
        if (area <= 0) continue;
        const double wb = cross(p - a, c - a) / area, wc = cross(b - a, p - a) / area, wa = 1 - wb - wc;
        on_edge = on_edge || (std::min({wa, wb, wc}) > -1e-3 && std::min({wa, wb, wc}) < 1e-3);
        if (wa < 0 || wb < 0 || wc < 0) continue;
        ++layers;
        const double z = wa * corner(now, 0).z + wb * corner(now, 1).z + wc * corner(now, 2).z;
        if (z >= nearest) continue;
        nearest = z;
        const glm::dvec2 texture = (wa * glm::dvec2(corner(seen, 0)) + wb * glm::dvec2(corner(seen, 1)) +
                                    wc * glm::dvec2(corner(seen, 2))) /
                                   64.0;
        grey = texture.x - 0.5 + (texture.y - 0.5) / 2;
      }
      if (layers == 0 || on_edge) continue;
      ++compared;
      if (layers > 1) ++hidden;
      if (std::abs(out.y.row(y)[x] - grey) > 1.5) ++softened;
    }
  }
  EXPECT_GT(compared, 2000);
  EXPECT_GT(hidden, 50) << "the case must occur";
  EXPECT_LT(softened, compared / 20) << "along silhouettes";
}

TEST(Renderer, SurvivesEveryStateOfAStream) {
  std::mt19937 random(10);
  Renderer renderer;
  Picture out;
  for (int i = 0; i < 150; ++i) {
    Scene scene;
    scene.setup = toy_setup(65, 64);
    scene.geometry.emplace(scene.setup, toy_geometry(), even_surround(4, 3, static_cast<int>(random() % 5)),
                           random_state(random));
    scene.patterns.push_back(make_pattern(noise_picture(65, 64, 11), random_state(random), scene.geometry));
    ASSERT_TRUE(renderer.render(scene, random_state(random), out));
    ASSERT_EQ(out.width(), 65);
    ASSERT_EQ(out.u.width, 33);
  }
}

// A head without depth is a plane: it moves the surround, is not drawn, and neither light nor mouth shows.
TEST(Renderer, PlaneMovesTheSurroundAndIsNotDrawn) {
  Geometry flat = toy_geometry();
  for (glm::ivec3& p : flat.positions) p = {6 * p.x, 6 * p.y, 0};
  const Picture picture = noise_picture(160, 128, 23);
  const State rest = toy_state();
  Scene scene;
  scene.setup = toy_setup();
  scene.geometry.emplace(scene.setup, flat, even_surround(4, 4, 0), rest);
  scene.patterns.push_back(make_pattern(picture, rest, scene.geometry));
  ASSERT_TRUE(scene.geometry->is_plane());
  EXPECT_TRUE(scene.patterns[0].atlas.empty());
  State moved = toy_state(86, 46);  // 6 pixels right, 4 up
  moved.light[kLightOffset] = 16 * 50;
  const Picture out = rendered(scene, moved);
  for (int y = 48; y < 80; ++y)
    for (int x = 48; x < 112; ++x) ASSERT_EQ(out.y.row(y)[x], picture.y.row(y + 4)[x - 6]) << x << ',' << y;
  for (int y = 24; y < 40; ++y)
    for (int x = 24; x < 56; ++x) ASSERT_EQ(out.u.row(y)[x], picture.u.row(y + 2)[x - 3]);
}

TEST(Renderer, AreaOfLumaIsThatOfTheWholePicture) {
  std::mt19937 random(21);
  const Scene scene =
      scene_seen_in(random_state(random), noise_picture(161, 127, 22), even_surround(6, 6, 3, 1));
  const State state = random_state(random);
  const Plane whole = rendered(scene, state).y;
  Renderer renderer;
  for (const SampleArea& area : {SampleArea{0, 0, 161, 127},
                                 {40, 30, 120, 100},
                                 {-20, -10, 33, 40},
                                 {150, 100, 400, 300},
                                 {200, 10, 300, 60}}) {
    Plane out(161, 127);
    ASSERT_TRUE(renderer.render_luma(scene, state, area, out));
    for (int y = std::max(area.y0, 0); y < std::min(area.y1, 127); ++y)
      for (int x = std::max(area.x0, 0); x < std::min(area.x1, 161); ++x)
        ASSERT_EQ(out.row(y)[x], whole.row(y)[x]) << x << ' ' << y;
  }
  Plane other(160, 127);
  EXPECT_EQ(renderer.render_luma(scene, state, {}, other).error().code, ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace fbs
