#include "decoder/export/head_pose_track.h"

#include <gtest/gtest.h>

#include "decoder/head/head_deformation.h"
#include "decoder/head/head_projection.h"
#include "tests/unit/decoder/export/recorded_talk.h"

namespace fbs {
namespace {

/// Where a viewer of the model sees the vertices, pixels and y up.
std::vector<glm::dvec3> model_points(const Geometry& head, const State& state) {
  const HeadMorphs morphs(head);
  const auto weights = morphs.weights(state);
  auto points = model_vertices(head);
  for (std::size_t t = 0; t < weights.size(); ++t)
    for (std::size_t v = 0; v < points.size(); ++v)
      points[v] += weights[t] * morphs.targets()[t].displacements[v];
  const ModelPose pose = model_pose(state);
  for (glm::dvec3& p : points) p = pose.translation + pose.scale * (pose.rotation * p);
  return points;
}

TEST(HeadMorphs, AndPoseGiveTheVerticesOfTheDecoder) {
  const Geometry head = toy_geometry();
  for (unsigned seed = 0; seed < 12; ++seed) {
    State state = grimace(seed);
    state.pose[kPitch] = 1000 * static_cast<int>(seed);
    state.pose[kYaw] = 8000 - 1500 * static_cast<int>(seed);
    state.pose[kRoll] = -700 * static_cast<int>(seed);
    state.pose[kLogScale] += 300 * static_cast<int>(seed);
    const auto points = model_points(head, state);
    const auto expected = project_vertices(head, state);
    for (std::size_t v = 0; v < kVertexCount; ++v) {
      EXPECT_NEAR(points[v].x, expected[v].x / 64.0, 0.05) << "vertex " << v << ", seed " << seed;
      EXPECT_NEAR(-points[v].y, expected[v].y / 64.0, 0.05) << "vertex " << v << ", seed " << seed;
    }
  }
}

TEST(HeadMorphs, KeepThePupilBetweenLidsThatClose) {
  const Geometry head = toy_geometry();
  State state = toy_state();
  for (const FeatureId lid : {FeatureId::kUpperLidRight, FeatureId::kUpperLidLeft})
    for (std::size_t i = 0; i < 2; ++i) state.control[feature(lid).first_control + i].y = 2000;
  const HeadMorphs morphs(head);
  const auto weights = morphs.weights(state);
  EXPECT_EQ(morphs.targets()[weights.size() - 1].name, "pupilLeftDown");
  EXPECT_NE(weights[weights.size() - 1], 0);
  const std::size_t pupil = feature(FeatureId::kPupilLeft).vertices.front().vertex;
  EXPECT_NEAR(-model_points(head, state)[pupil].y, project_vertices(head, state)[pupil].y / 64.0, 0.05);
}

TEST(HeadMorphs, LeaveOpenEyesAlone) {
  const HeadMorphs morphs(toy_geometry());
  for (const double w : morphs.weights(toy_state())) EXPECT_EQ(w, 0);
}

TEST(VertexNormals, PointToTheViewerInFront) {
  const auto normals =
      vertex_normals({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}}, std::vector<std::uint16_t>{0, 1, 2});
  EXPECT_EQ(normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(normals[3], glm::vec3(0, 0, 1));  // in no triangle
}

}  // namespace
}  // namespace fbs
