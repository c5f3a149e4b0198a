#include "decoder/projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/mat3x3.hpp>
#include <numbers>

#include "bitstream/geometry_payload.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr double kTurn = 2 * std::numbers::pi / 65536;

/// The documentation of HeadPose in doubles: roll * yaw * pitch, each the usual right-handed matrix.
struct PlainProjection {
  glm::dmat3 rotation;
  double scale;  ///< pixels per head unit
  glm::dvec2 shift;

  explicit PlainProjection(const HeadPose& pose)
      : rotation(about(2, pose.roll * kTurn) * about(1, pose.yaw * kTurn) * about(0, pose.pitch * kTurn)),
        scale(std::exp2(pose.log_scale / 4096.0) / kUnitsPerEyeDistance),
        shift(pose.shift_x / 64.0, pose.shift_y / 64.0) {}

  /// Pixels.
  [[nodiscard]] glm::dvec2 operator()(glm::dvec3 p) const { return glm::dvec2(rotation * p) * scale + shift; }

 private:
  static glm::dmat3 about(int axis, double angle) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    glm::dmat3 m(1);  // m[column][row]
    m[i][i] = m[j][j] = std::cos(angle);
    m[i][j] = std::sin(angle);
    m[j][i] = -std::sin(angle);
    return m;
  }
};

HeadPose random_pose(std::mt19937& random) {
  const auto within = [&](int a, int b) { return std::uniform_int_distribution<int>(a, b)(random); };
  const int turn = kMaxRotation;
  return {within(-turn, turn), within(-turn, turn), within(-turn, turn),
          within(0, 400 * 64), within(0, 300 * 64), within(3 * 4096, kMaxLogScale)};
}

// The rotation is in Q14: its share of the error grows with the head and is 1/32 pixel at 80 pixels between
// the eyes.
TEST(HeadProjection, IsWithinA32thOfAPixelOfThePlainOne) {
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    const HeadPose pose = random_pose(random);
    const HeadProjection projection(pose);
    const PlainProjection plain(pose);
    const double tolerance = std::max(1.0, std::exp2(pose.log_scale / 4096.0) / 72) / 32;
    for (const HeadVertex& v : generic_head().vertices) {
      const glm::ivec3 got = projection(v.position);
      const glm::dvec2 expected = plain(glm::dvec3(v.position));
      ASSERT_NEAR(got.x / 64.0, expected.x, tolerance);
      ASSERT_NEAR(got.y / 64.0, expected.y, tolerance);
      ASSERT_NEAR(got.z, (plain.rotation * glm::dvec3(v.position)).z, 2);  // head units
    }
  }
}

TEST(HeadProjection, SignsOfRotationAreThoseOfTheDocumentation) {
  const glm::ivec3 nose(0, 0, -4096), left_eye(2048, 0, 0);
  HeadPose pose;
  pose.log_scale = 5 * 4096;
  pose.pitch = 1000;
  EXPECT_GT(HeadProjection(pose)(nose).y, 0) << "looks down";
  pose.pitch = 0;
  pose.yaw = 1000;
  EXPECT_LT(HeadProjection(pose)(nose).x, 0) << "turns to the picture's left";
  pose.yaw = 0;
  pose.roll = 1000;
  EXPECT_GT(HeadProjection(pose)(left_eye).y, 0) << "turns clockwise";
}

TEST(HeadProjection, ScreenPositionsAreClamped) {
  HeadPose pose;
  pose.log_scale = kMaxLogScale;
  pose.shift_x = kMaxTranslation;
  pose.shift_y = -kMaxTranslation;
  const HeadProjection projection(pose);
  EXPECT_EQ(glm::ivec2(projection({kMaxCoordinate, -kMaxCoordinate, 0})),
            glm::ivec2(kMaxScreen, -kMaxScreen));
}

TEST(DequantisePose, MultipliesWithTheSteps) {
  State state;
  state.pose = {1, -2, 3, -4, 5, 6};
  EXPECT_EQ(dequantise_pose(state, {10, 100, 1000, 1}), (HeadPose{10, -20, 30, -400, 500, 6000}));
}

TEST(Deform, NeutralStateLeavesTheHeadAlone) {
  const auto neutral = toy_geometry().positions;
  EXPECT_EQ(deform(neutral, State{}, QuantiserSteps{}), neutral);
}

TEST(Deform, AddsEachControlPointByItsWeight) {
  std::mt19937 random(3);
  const auto neutral = toy_geometry().positions;
  State state;
  for (glm::ivec2& c : state.control)
    c = {static_cast<int>(random() % 41) - 20, static_cast<int>(random() % 41) - 20};
  const QuantiserSteps steps{1, 1, 1, 37};
  const auto moved = deform(neutral, state, steps);
  const GenericHead& head = generic_head();
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    if (head.vertices[v].feature >= static_cast<int>(FeatureId::kPupilRight))
      continue;  // kept between the lids
    glm::dvec2 offset(0);
    for (std::size_t k = head.spread_begin[v]; k < head.spread_begin[v + 1]; ++k)
      offset += glm::dvec2(state.control[static_cast<std::size_t>(head.spread[k].control)]) * 37.0 *
                (head.spread[k].weight / static_cast<double>(kSpreadOne));
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
    const auto vertices = deform(toy_geometry().positions, state, {1, 1, 1, 1});
    const auto y_of = [&](FeatureId id) {
      std::vector<int> y;
      for (const FeatureVertex& v : feature(id).vertices)
        y.push_back(vertices[static_cast<std::size_t>(v.vertex)].y);
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
    open.control[static_cast<std::size_t>(inner.first_control + i)].y =
        i >= inner.control_count / 2 ? 800 : 0;
  EXPECT_GT(mouth_gap(deform(neutral, open, {1, 1, 1, 1})), mouth_gap(neutral) + 400);
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
      ASSERT_TRUE(mesh.triangles[t][i] >= 0 && mesh.triangles[t][i] < mesh.vertex_count);
      const glm::ivec3 p = screen.head[static_cast<std::size_t>(mesh.triangles[t][i])];
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
    const glm::ivec3 ring = rest.head[kVertexCount + i],
                     edge = rest.head[static_cast<std::size_t>(outline[i])];
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

TEST(SceneGeometry, SeenStateGivesTheRegularGrid) {
  State seen = toy_state(70, 60);
  seen.pose[kYaw] = 900;
  seen.pose[kRoll] = -1500;
  const SceneGeometry geometry(toy_setup(165, 127), toy_geometry(), even_surround(7, 5, kFollowOne), seen);
  const auto grid = geometry.project(seen).surround;
  ASSERT_EQ(grid.size(), 48u);
  for (int r = 0; r <= 5; ++r)
    for (int c = 0; c <= 7; ++c)
      EXPECT_EQ(grid[static_cast<std::size_t>(r * 8 + c)], glm::ivec2(165 * 64 * c / 7, 127 * 64 * r / 5));
}

TEST(SceneGeometry, SurroundFollowsAShiftByItsShare) {
  for (int follow = 0; follow <= kFollowOne; ++follow) {
    const SceneGeometry geometry(toy_setup(), toy_geometry(), even_surround(8, 8, follow), toy_state());
    const auto before = geometry.project(toy_state()).surround,
               after = geometry.project(toy_state(88, 46)).surround;
    for (int r = 0; r <= 8; ++r) {
      for (int c = 0; c <= 8; ++c) {
        const auto k = static_cast<std::size_t>(r * 9 + c);
        const bool border = r == 0 || c == 0 || r == 8 || c == 8;
        const glm::ivec2 expected = border ? glm::ivec2(0) : glm::ivec2(8 * 16 * follow, -4 * 16 * follow);
        EXPECT_EQ(after[k] - before[k], expected) << r << ' ' << c;
      }
    }
  }
}

TEST(SceneGeometry, BorderStaysWhateverTheMapSays) {
  SurroundMap map = even_surround(4, 4, kFollowOne);
  map.follow.assign(map.follow.size(), kFollowOne);
  const SceneGeometry geometry(toy_setup(), toy_geometry(), map, toy_state());
  const auto before = geometry.project(toy_state()).surround,
             after = geometry.project(toy_state(100, 70)).surround;
  for (std::size_t k = 0; k < 25; ++k) {
    const bool border = k < 5 || k >= 20 || k % 5 == 0 || k % 5 == 4;
    EXPECT_EQ(before[k] == after[k], border) << k;
  }
}

// A point of the surround is a point of the head frame's plane z = 0.
TEST(SceneGeometry, SurroundThatFollowsWhollyMovesAsTheHeadsPlane) {
  std::mt19937 random(5);
  for (int i = 0; i < 200; ++i) {
    State seen = toy_state(), now = toy_state();
    for (State* s : {&seen, &now}) {
      for (const int k : {kPitch, kYaw, kRoll})
        s->pose[static_cast<std::size_t>(k)] = static_cast<int>(random() % 10000) - 5000;
      s->pose[kShiftX] += static_cast<int>(random() % 2000) - 1000;
      s->pose[kShiftY] += static_cast<int>(random() % 2000) - 1000;
      s->pose[kLogScale] += static_cast<int>(random() % 2000) - 1000;
    }
    const SceneGeometry geometry(toy_setup(), toy_geometry(), even_surround(6, 6, kFollowOne), seen);
    const auto before = geometry.project(seen).surround, after = geometry.project(now).surround;
    const PlainProjection from(dequantise_pose(seen, {1, 1, 1, 1})), to(dequantise_pose(now, {1, 1, 1, 1}));
    const glm::dmat2 a(glm::dvec2(from.rotation[0]) * from.scale, glm::dvec2(from.rotation[1]) * from.scale);
    const double det = a[0].x * a[1].y - a[1].x * a[0].y;
    for (std::size_t k = 8; k < 41; ++k) {
      if (k % 7 == 0 || k % 7 == 6) continue;
      const glm::dvec2 d = glm::dvec2(before[k]) / 64.0 - from.shift;
      const glm::dvec3 plane((a[1].y * d.x - a[1].x * d.y) / det, (-a[0].y * d.x + a[0].x * d.y) / det, 0);
      const glm::dvec2 expected = to(plane);
      ASSERT_NEAR(after[k].x / 64.0, expected.x, 1.0 / 16);
      ASSERT_NEAR(after[k].y / 64.0, expected.y, 1.0 / 16);
    }
  }
}

TEST(SceneGeometry, SurroundStaysWhenThePatternSawTheHeadFromTheSide) {
  State seen = toy_state(), now = toy_state(90, 50);
  seen.pose[kYaw] = 16000;
  const SceneGeometry geometry(toy_setup(), toy_geometry(), even_surround(6, 6, kFollowOne), seen);
  EXPECT_EQ(geometry.project(now).surround, geometry.project(seen).surround);
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
