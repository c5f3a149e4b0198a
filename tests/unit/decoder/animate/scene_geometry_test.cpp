#include "decoder/animate/scene_geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "bitstream/payload/geometry_payload.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

TEST(SceneGeometry, RingLiesOutsideTheOutlineAndBehindIt) {
  const SceneGeometry geometry(toy_setup(), toy_geometry(), even_surround(2, 2, 0), toy_state());
  const ScreenMesh rest = geometry.screen_mesh(toy_state());
  const auto outline = generic_head().outline;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::ivec3 ring = rest.head[kVertexCount + i], edge = rest.head[outline[i]];
    EXPECT_GT(ring.z, edge.z) << "the face hides it";
    const glm::dvec2 centre = glm::dvec2(80, 50) * 64.0;
    const glm::dvec2 inner = glm::dvec2(edge) - centre, outer = glm::dvec2(ring) - centre;
    EXPECT_GT(std::hypot(outer.x, outer.y), 1.1 * std::hypot(inner.x, inner.y));
  }
}

std::vector<glm::ivec2> ring_of(const ScreenMesh& mesh) {
  return {mesh.head.begin() + kVertexCount, mesh.head.end()};
}

// The ring is carried by what lies under it: ground that stays must not be dragged along.
TEST(SceneGeometry, RingGoesWithTheSurround) {
  State moved = toy_state(84, 45);
  for (glm::ivec2& c : moved.control) c = {500, 900};
  const SceneGeometry still(toy_setup(), toy_geometry(), even_surround(32, 32, 0), toy_state());
  EXPECT_EQ(ring_of(still.screen_mesh(moved)), ring_of(still.screen_mesh(toy_state())));
  const SceneGeometry following(toy_setup(), toy_geometry(), even_surround(32, 32, kFollowOne), toy_state());
  const auto before = ring_of(following.screen_mesh(toy_state())),
             after = ring_of(following.screen_mesh(moved));
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(after[i] - before[i], glm::ivec2(4 * 64, -5 * 64)) << i;
}

// In the rest state, pattern 0's, the mesh lies at the same place on the screen and in the pattern.
TEST(SceneGeometry, TextureOfTheRestStateIsWhereTheRestStateIsDrawn) {
  State rest = toy_state();
  rest.light = {160, -48, 200, -300};
  rest.control[3] = {200, 300};
  const SceneGeometry geometry(toy_setup(), toy_geometry(), even_surround(6, 5, 3), rest);
  const ScreenMesh screen = geometry.screen_mesh(rest);
  const TextureMesh texture = geometry.texture_mesh(rest);
  ASSERT_EQ(texture.head.size(), screen.head.size());
  for (std::size_t v = 0; v < screen.head.size(); ++v)
    EXPECT_EQ(texture.head[v], glm::ivec2(screen.head[v])) << v;
  EXPECT_EQ(texture.surround, screen.surround);
  EXPECT_EQ(texture.light, screen.light);
  EXPECT_EQ(texture.mouth_gap, screen.mouth_gap);
  for (int r = 0; r <= 5; ++r) {
    for (int c = 0; c <= 6; ++c) {
      const glm::ivec2 regular(128 + (160 * 64 - 256) * c / 6, 128 + (128 * 64 - 256) * r / 5);
      EXPECT_EQ(texture.surround[(r + 1) * 9 + c + 1], regular) << c << ' ' << r;
    }
  }
  EXPECT_EQ(texture.surround.front(), glm::ivec2(128 - 32 * 160, 128 - 32 * 128)) << "half a picture away";
}

TEST(SceneGeometry, TextureOfAnyStateIsWhereThatStateIsDrawn) {
  std::mt19937 random(8);
  const SceneGeometry geometry(toy_setup(), toy_geometry(), even_surround(6, 5, 3), toy_state());
  for (int i = 0; i < 50; ++i) {
    const State seen = random_state(random);
    const ScreenMesh screen = geometry.screen_mesh(seen);
    const TextureMesh texture = geometry.texture_mesh(seen);
    for (std::size_t v = 0; v < screen.head.size(); ++v)
      ASSERT_EQ(texture.head[v], glm::ivec2(screen.head[v])) << v;
    EXPECT_EQ(texture.surround, screen.surround);
    EXPECT_EQ(texture.light, screen.light);
    EXPECT_EQ(texture.mouth_gap, screen.mouth_gap);
  }
}

TEST(SceneGeometry, VerticesAreThoseOfTheScreenMesh) {
  std::mt19937 random(9);
  const SceneGeometry geometry(toy_setup(), toy_geometry(), even_surround(6, 5, 3), toy_state());
  for (int i = 0; i < 20; ++i) {
    const State state = random_state(random);
    const auto vertices = geometry.project_vertices(state);
    EXPECT_TRUE(std::equal(vertices.begin(), vertices.end(), geometry.screen_mesh(state).head.begin()));
  }
}

TEST(SceneGeometry, StaysInRangeForEveryStateOfAStream) {
  std::mt19937 random(6);
  Geometry largest;
  for (glm::ivec3& p : largest.positions) {
    const auto corner = [&] { return random() % 2 == 0 ? kMaxCoordinate : -kMaxCoordinate; };
    p = {corner(), corner(), corner()};
  }
  for (int i = 0; i < 300; ++i) {
    const State rest = random_state(random);
    const SceneGeometry geometry(toy_setup(8191, 64), i % 2 == 0 ? largest : toy_geometry(),
                                 even_surround(5, 5, 4), rest);
    const ScreenMesh mesh = geometry.screen_mesh(random_state(random));
    const auto inside = [](std::int32_t v) { return std::abs(v) <= kMaxScreen; };
    for (const glm::ivec3& p : mesh.head) ASSERT_TRUE(inside(p.x) && inside(p.y));
    for (const glm::ivec2& p : mesh.surround) ASSERT_TRUE(inside(p.x) && inside(p.y));
  }
}

}  // namespace
}  // namespace fbs
