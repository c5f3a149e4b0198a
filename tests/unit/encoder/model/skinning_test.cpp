#include "encoder/model/skinning.h"

#include <gtest/gtest.h>

#include "decoder/head/head_deformation.h"
#include "decoder/head/mouth_interior.h"
#include "encoder/model/placed_head.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

State random_face(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> offset(-150, 150);
  State state = toy_state();
  for (glm::ivec2& c : state.control) c = {offset(random), offset(random)};
  state.pose[kYaw] = 3 * offset(random);
  state.pose[kPitch] = 3 * offset(random);
  state.pose[kRoll] = 3 * offset(random);
  return state;
}

bool is_pupil(std::size_t v) {
  return v == feature(FeatureId::kPupilRight).vertices.front().vertex ||
         v == feature(FeatureId::kPupilLeft).vertices.front().vertex;
}

TEST(Skinning, IsTheDecodersDeformWithinHalfAUnit) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const State state = random_face(seed);
    const auto decoded = deform(toy_geometry(), state);
    const HeadVertices vertices = skinned(toy_geometry(), fit_of(state).offsets);
    for (std::size_t v = 0; v < kVertexCount; ++v) {
      EXPECT_NEAR(vertices[v].x, decoded[v].x, 0.501) << v;
      // The decoder keeps pupils between the lids.
      if (!is_pupil(v)) {
        EXPECT_NEAR(vertices[v].y, decoded[v].y, 0.501) << v;
      }
      EXPECT_EQ(vertices[v].z, decoded[v].z) << v;
    }
    EXPECT_NEAR(mouth_gap(vertices), mouth_gap(generic_head(), decoded), 1);
  }
}

TEST(Skinning, OfNoOffsetsIsTheAdaptedHead) {
  const Geometry geometry = toy_geometry();
  const HeadVertices vertices = skinned(geometry, {});
  for (std::size_t v = 0; v < kVertexCount; ++v) EXPECT_EQ(vertices[v], glm::dvec3(geometry.positions[v]));
}

TEST(PlacedHead, IsWhereTheDecoderProjectsIt) {
  const State state = random_face(3);
  const Scene scene = toy_scene(Picture(160, 128));
  const auto decoded = scene.geometry->project_vertices(state);
  const PlacedHead head(toy_geometry(), fit_of(state));
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    const glm::dvec2 at = head.projection(head.vertices[v]) * static_cast<double>(1 << kScreenOneLog2);
    EXPECT_NEAR(at.x, decoded[v].x, 2) << v;
    if (!is_pupil(v)) {
      EXPECT_NEAR(at.y, decoded[v].y, 2) << v;
    }
  }
}

TEST(PlacedHead, TrianglesThatFaceAwayHaveNoVisibleArea) {
  const PlacedHead head(toy_geometry(), fit_of(toy_state()));
  for (const HeadTriangle& t : generic_head().triangles) {
    const HeadTriangle behind = {t[0], t[2], t[1]};
    EXPECT_EQ(std::min(head.visible_area(t), head.visible_area(behind)), 0);
  }
  // Half of an eye distance squared at 32 pixels between the eyes.
  PlacedHead square(toy_geometry(), fit_of(toy_state()));
  square.vertices[0] = {0, 0, 0};
  square.vertices[1] = {kUnitsPerEyeDistance, 0, 0};
  square.vertices[2] = {0, kUnitsPerEyeDistance, 0};
  EXPECT_NEAR(square.visible_area({0, 1, 2}), 0.5 * 32 * 32, 1e-6);
}

}  // namespace
}  // namespace fbs
