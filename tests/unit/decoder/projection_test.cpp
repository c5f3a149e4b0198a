#include "decoder/animate/projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "bitstream/payload/geometry_payload.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

TEST(Deform, NeutralStateLeavesTheHeadAlone) {
  const auto neutral = toy_geometry().positions;
  EXPECT_EQ(deform(neutral, State{}), neutral);
}

TEST(Deform, AddsEachControlPointByItsWeight) {
  std::mt19937 random(3);
  const auto neutral = toy_geometry().positions;
  State state;
  for (glm::ivec2& c : state.control)
    c = {static_cast<int>(random() % 1501) - 750, static_cast<int>(random() % 1501) - 750};
  const auto moved = deform(neutral, state);
  const GenericHead& head = generic_head();
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    if (head.vertices[v].feature >= static_cast<int>(FeatureId::kPupilRight))
      continue;  // kept between the lids
    glm::dvec2 offset(0);
    for (std::size_t k = head.skinning_begin[v]; k < head.skinning_begin[v + 1]; ++k)
      offset += glm::dvec2(state.control[head.skinning[k].control]) *
                (head.skinning[k].weight / static_cast<double>(kSkinningOne));
    EXPECT_NEAR(moved[v].x - neutral[v].x, offset.x, 0.501);
    EXPECT_NEAR(moved[v].y - neutral[v].y, offset.y, 0.501);
    EXPECT_EQ(moved[v].z, neutral[v].z);
  }
}

// Lids that shut or cross would fold the triangles of the eye.
TEST(Deform, KeepsPupilsBetweenTheLids) {
  std::mt19937 random(4);
  int shut = 0;
  for (int i = 0; i < 500; ++i) {
    State state;
    for (glm::ivec2& c : state.control) c = {0, static_cast<int>(random() % 2001) - 1000};
    const auto vertices = deform(toy_geometry().positions, state);
    const auto y_of = [&](FeatureId id) {
      std::vector<int> y;
      for (const FeatureVertex& v : feature(id).vertices) y.push_back(vertices[v.vertex].y);
      return y;
    };
    const auto upper = y_of(FeatureId::kUpperLidLeft), lower = y_of(FeatureId::kLowerLidLeft);
    const int low = *std::max_element(upper.begin(), upper.end()),
              high = *std::min_element(lower.begin(), lower.end());
    const int pupil = y_of(FeatureId::kPupilLeft).front();
    if (low >= high) ++shut;
    ASSERT_TRUE(pupil >= std::min(low, high) && pupil <= std::max(low, high)) << i;
  }
  EXPECT_TRUE(shut > 20 && shut < 480) << "both cases must occur";
}

TEST(Mouth, ShadeGrowsAsTheLipsPart) {
  EXPECT_EQ(mouth_shade(-500, 100), 0);
  EXPECT_EQ(mouth_shade(100, 100), 0) << "as the pattern saw it";
  EXPECT_EQ(mouth_shade(228, 100), 128);
  EXPECT_EQ(mouth_shade(5000, 100), 256);
}

TEST(Mouth, GapIsThatOfTheInnerLips) {
  State open;
  const Feature& inner = feature(FeatureId::kMouthInner);
  const auto neutral = toy_geometry().positions;
  for (const FeatureVertex& v : inner.vertices) EXPECT_TRUE(is_inner_lip(v.vertex));
  for (int i = 0; i < inner.control_count; ++i)
    open.control[inner.first_control + i].y = i >= inner.control_count / 2 ? 800 : 0;
  EXPECT_GT(mouth_gap(deform(neutral, open)), mouth_gap(neutral) + 400);
  for (std::int16_t v = kVertexCount; v < head_mesh().vertex_count; ++v)
    EXPECT_FALSE(is_inner_lip(v)) << "a ring vertex";
}

TEST(HeadMesh, FacesTheViewerFromTheFront) {
  const HeadMesh& mesh = head_mesh();
  EXPECT_EQ(mesh.vertex_count, kVertexCount + static_cast<int>(generic_head().outline.size()));
  const SceneGeometry geometry(toy_setup(), toy_geometry(), even_surround(2, 2, 0), toy_state());
  const ScreenMesh screen = geometry.project(toy_state());
  ASSERT_EQ(screen.head.size(), static_cast<std::size_t>(mesh.vertex_count));
  const std::size_t ring_begins = generic_head().triangles.size();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    RasterTriangle corners;
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_TRUE(mesh.triangles[t][i] < mesh.vertex_count);
      const glm::ivec3 p = screen.head[mesh.triangles[t][i]];
      corners[i] = {{p.x, p.y}, {}, p.z};
    }
    EXPECT_TRUE(faces_viewer(corners)) << (t < ring_begins ? "head " : "ring ") << t;
  }
}

TEST(SceneGeometry, RingLiesOutsideTheOutlineAndBehindIt) {
  const SceneGeometry geometry(toy_setup(), toy_geometry(), even_surround(2, 2, 0), toy_state());
  const ScreenMesh rest = geometry.project(toy_state());
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

// What lies under the ring carries it: ground that stays must not be dragged along.
TEST(SceneGeometry, RingGoesWithTheSurround) {
  State moved = toy_state(84, 45);
  for (glm::ivec2& c : moved.control) c = {500, 900};
  const SceneGeometry still(toy_setup(), toy_geometry(), even_surround(32, 32, 0), toy_state());
  EXPECT_EQ(ring_of(still.project(moved)), ring_of(still.project(toy_state())));
  const SceneGeometry following(toy_setup(), toy_geometry(), even_surround(32, 32, kFollowOne), toy_state());
  const auto before = ring_of(following.project(toy_state())), after = ring_of(following.project(moved));
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(after[i] - before[i], glm::ivec2(4 * 64, -5 * 64)) << i;
}

/// What the light of `state` adds at each vertex of the toy scene.
std::vector<VertexLight> light_of(const State& state) {
  const SceneGeometry geometry(toy_setup(), toy_geometry(), even_surround(2, 2, 0), toy_state());
  return geometry.project(state).light;
}

TEST(SceneGeometry, LightIsThatOfTheRestingVertexAndEndsAtTheRing) {
  State state = toy_state();
  state.light = {160, -48, 200, -300};
  state.control[0] = {900, 900};  // does not count
  const auto light = light_of(state);
  ASSERT_EQ(light.size(), static_cast<std::size_t>(head_mesh().vertex_count));
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    const glm::dvec3 p = glm::dvec3(toy_geometry().positions[v]) / 4096.0;
    EXPECT_NEAR(light[v].offset, 160 + 200 * p.x - 300 * p.y, 0.501) << v;
    EXPECT_EQ(light[v].gain, -48);
  }
  for (std::size_t v = kVertexCount; v < light.size(); ++v)
    EXPECT_TRUE(light[v].offset == 0 && light[v].gain == 0) << "ring " << v;
}

TEST(SceneGeometry, LightIsClampedAndNoneIsNotSaid) {
  EXPECT_TRUE(light_of(toy_state()).empty());
  State state = toy_state();
  state.light = {kMaxLight, 0, kMaxLight, kMaxLight};
  int clamped = 0;
  for (const VertexLight& l : light_of(state)) {
    EXPECT_LE(std::abs(l.offset), kMaxLight);
    clamped += l.offset == kMaxLight ? 1 : 0;
  }
  EXPECT_GT(clamped, 20) << "the case must occur";
}
TEST(SceneGeometry, StaysInRangeForEveryStateOfAStream) {
  std::mt19937 random(6);
  Geometry largest;
  for (glm::ivec3& p : largest.positions) {
    const auto corner = [&] { return random() % 2 == 0 ? kMaxCoordinate : -kMaxCoordinate; };
    p = {corner(), corner(), corner()};
  }
  for (int i = 0; i < 300; ++i) {
    const State seen = random_state(random);
    const SceneGeometry geometry(toy_setup(8191, 64), i % 2 == 0 ? largest : toy_geometry(),
                                 even_surround(5, 5, 4), seen);
    const ScreenMesh mesh = geometry.project(random_state(random));
    const auto inside = [](std::int32_t v) { return std::abs(v) <= kMaxScreen; };
    for (const glm::ivec3& p : mesh.head) ASSERT_TRUE(inside(p.x) && inside(p.y));
    for (const glm::ivec2& p : mesh.surround) ASSERT_TRUE(inside(p.x) && inside(p.y));
  }
}

}  // namespace
}  // namespace fbs
