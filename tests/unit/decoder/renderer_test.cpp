#include "decoder/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <functional>

#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

TEST(Renderer, StateOfThePatternReproducesThePatternExactly) {
  for (const auto& [w, h] : {std::pair{160, 128}, {161, 127}, {64, 64}, {97, 200}}) {
    const Scene scene = toy_scene(noise_picture(w, h, 1), even_surround(9, 7, kFollowOne));
    EXPECT_EQ(rendered(scene, toy_state()), scene.patterns[0].picture) << w << 'x' << h;
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
    scene.patterns.push_back({noise_picture(160, 128, 3), scene.geometry->project(seen)});
    renderer.render(scene, seen, out);
    ASSERT_EQ(out, scene.patterns[0].picture) << i;
  }
}

TEST(Renderer, SceneWithoutGeometryShowsItsPatternAsItIs) {
  Scene scene;
  scene.setup = toy_setup();
  scene.patterns.push_back({noise_picture(160, 128, 4), {}});
  EXPECT_EQ(rendered(scene, toy_state(12, 100)), scene.patterns[0].picture);
}

TEST(Renderer, DependsOnItsArgumentsAlone) {
  const Scene scene = toy_scene(noise_picture(160, 128, 5), even_surround(8, 8, 2));
  State turned = toy_state(70, 60);
  turned.pose[kYaw] = 3000;
  Renderer renderer;
  Picture first, other(33, 44), again;
  renderer.render(scene, turned, first);
  renderer.render(scene, toy_state(), other);
  renderer.render(scene, turned, again);
  EXPECT_EQ(first, again);
  EXPECT_NE(first, other);
  EXPECT_EQ(other.width(), 160);
}

/// Times that the closed polygon goes round the centre of luma sample (x, y), clockwise.
int winding(const std::vector<glm::ivec2>& polygon, int x, int y) {
  const int px = x * 64 + 32, py = y * 64 + 32;
  int turns = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::ivec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const std::int64_t side = std::int64_t{b.x - a.x} * (py - a.y) - std::int64_t{b.y - a.y} * (px - a.x);
    if (a.y <= py && b.y > py && side > 0) ++turns;
    if (a.y > py && b.y <= py && side < 0) --turns;
  }
  return turns;
}

std::vector<glm::ivec2> outline_of(const ScreenMesh& mesh) {
  std::vector<glm::ivec2> out;
  for (const std::int16_t v : generic_head().outline) out.emplace_back(mesh.head[v]);
  return out;
}

std::vector<glm::ivec2> ring_of(const ScreenMesh& mesh) {
  return {mesh.head.begin() + kVertexCount, mesh.head.end()};
}

/// Bright where head and ring are in toy_state() and `reach` pixels round them, dark elsewhere.
Picture bright_head(int reach) {
  const auto ring = ring_of(toy_scene(Picture(160, 128)).patterns[0].seen);
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

State random_look(std::mt19937& random) {
  State state = toy_state(60 + static_cast<int>(random() % 40), 38 + static_cast<int>(random() % 30));
  state.pose[kPitch] = static_cast<int>(random() % 4000) - 2000;
  state.pose[kYaw] = static_cast<int>(random() % 6000) - 3000;
  state.pose[kRoll] = static_cast<int>(random() % 6000) - 3000;
  state.pose[kLogScale] += static_cast<int>(random() % 3000) - 1500;
  return state;
}

// Outline and ring close the mesh: wherever such a polygon goes round a sample, some triangle that faces the
// viewer lies there, and what it shows comes from the head. A crack would show the dark ground.
TEST(Renderer, MovedHeadShowsNoUncoveredPixel) {
  std::mt19937 random(6);
  const Picture bright = bright_head(2);
  for (int i = 0; i < 60; ++i) {
    const Scene scene = toy_scene(bright, even_surround(20, 16, i % 2 == 0 ? 0 : kFollowOne));
    const State state = random_look(random);
    const Picture out = rendered(scene, state);
    const ScreenMesh now = scene.geometry->project(state);
    const auto outline = outline_of(now), ring = ring_of(now);
    int inside = 0;
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 160; ++x) {
        if (winding(outline, x, y) < 1 && winding(ring, x, y) < 1) continue;
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
    const State state = random_look(random);
    const Picture out = rendered(scene, state);
    const ScreenMesh now = scene.geometry->project(state);
    std::vector<std::vector<glm::ivec2>> triangles;
    for (const auto& t : head_mesh().triangles) {
      triangles.emplace_back();
      for (const std::int16_t v : t) triangles.back().emplace_back(now.head[v]);
    }
    int compared = 0;
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 160; ++x) {
        if (std::any_of(triangles.begin(), triangles.end(),
                        [&](const auto& t) { return winding(t, x, y) > 0; }))
          continue;
        ++compared;
        ASSERT_EQ(out.y.row(y)[x], scene.patterns[0].picture.y.row(y)[x]);
      }
    }
    EXPECT_GT(compared, 5000);
  }
}

TEST(Renderer, SurroundThatFollowsMovesWithTheHead) {
  const Scene scene = toy_scene(noise_picture(160, 128, 8), even_surround(32, 32, kFollowOne));
  const Picture out = rendered(scene, toy_state(84, 48));  // 4 pixels right, 2 up
  const Picture& pattern = scene.patterns[0].picture;
  for (int y = 12; y < 116; ++y)
    for (int x = 18; x < 142; ++x) ASSERT_EQ(out.y.row(y)[x], pattern.y.row(y + 2)[x - 4]) << x << ',' << y;
  for (int y = 8; y < 56; ++y) {
    for (int x = 10; x < 70; ++x) {
      ASSERT_EQ(out.u.row(y)[x], pattern.u.row(y + 1)[x - 2]);
      ASSERT_EQ(out.v.row(y)[x], pattern.v.row(y + 1)[x - 2]);
    }
  }
}

// The outermost samples of many videos are dark: what comes in from outside repeats those within.
TEST(Renderer, DarkBorderIsNotRepeated) {
  Picture picture(160, 128);
  picture.y = Plane(160, 128, 200);
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 160; ++x)
      if (x == 0 || y == 0 || x == 159 || y == 127) picture.y.row(y)[x] = 10;
  const Scene scene = toy_scene(picture);
  EXPECT_EQ(rendered(scene, toy_state()), picture) << "where nothing moves it is as it was";
  for (const glm::ivec2 way : {glm::ivec2(10, 7), {-13, -4}, {40, -30}}) {
    State state = toy_state();
    state.ground = {64 * way.x, 64 * way.y, 0, 0};
    EXPECT_EQ(rendered(scene, state).y, Plane(160, 128, 200)) << way.x;
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
  const ScreenMesh now = scene.geometry->project(state);
  const ScreenMesh& seen = scene.patterns[0].seen;
  int compared = 0, hidden = 0;
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 160; ++x) {
      const glm::dvec2 p(x * 64 + 32, y * 64 + 32);
      double nearest = 1e18, grey = 0;
      int layers = 0;
      bool on_edge = false;
      for (const auto& t : head_mesh().triangles) {
        const auto corner = [&](const ScreenMesh& m, std::size_t i) { return m.head[t[i]]; };
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
      ASSERT_NEAR(out.y.row(y)[x], grey, 1.5) << x << ',' << y;
    }
  }
  EXPECT_GT(compared, 2000);
  EXPECT_GT(hidden, 50) << "the case must occur";
}

TEST(Renderer, SurvivesEveryStateOfAStream) {
  std::mt19937 random(10);
  Renderer renderer;
  Picture out;
  for (int i = 0; i < 150; ++i) {
    Scene scene;
    scene.setup = toy_setup(65, 64);
    const State seen = random_state(random);
    scene.geometry.emplace(scene.setup, toy_geometry(), even_surround(4, 3, static_cast<int>(random() % 5)),
                           seen);
    scene.patterns.push_back({noise_picture(65, 64, 11), scene.geometry->project(seen)});
    renderer.render(scene, random_state(random), out);
    ASSERT_EQ(out.width(), 65);
    ASSERT_EQ(out.u.width, 33);
  }
}

}  // namespace
}  // namespace fbs
