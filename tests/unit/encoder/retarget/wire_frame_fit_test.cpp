#include "encoder/retarget/wire_frame_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bitstream/payload/geometry_payload.h"
#include "bitstream/payload/wire_frame_payload.h"
#include "decoder/head/head_deformation.h"
#include "tests/unit/split_head.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr int kNear = kUnitsPerEyeDistance / 64;

/// Somebody: narrower, longer, with a longer nose and a mouth that is lower on one side.
Geometry somebody() {
  Geometry out = toy_geometry();
  for (glm::ivec3& p : out.positions) p = {p.x * 9 / 10, p.y * 11 / 10, p.z};
  out.positions[vertex_of_landmark(30)].z -= 500;
  out.positions[vertex_of_landmark(48)].y += 150;
  return out;
}

double distance(glm::ivec3 a, glm::ivec3 b) {
  const glm::dvec3 d(a - b);
  return std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
}

TEST(WireFrameFit, LandmarksAndPupilsAreWhereTheFaceHasThem) {
  const Geometry face = somebody(), fitted = fit_wire_frame(face, split_head());
  ASSERT_EQ(fitted.positions.size(), split_head()->vertices.size());
  for (std::size_t k = 0; k < kLandmarkCount; ++k)
    EXPECT_LT(distance(fitted.positions[fitted.wire_frame().vertex_of_landmark(k)],
                       face.positions[vertex_of_landmark(k)]),
              kNear)
        << k;
  for (const FeatureId id : {FeatureId::kPupilRight, FeatureId::kPupilLeft})
    EXPECT_LT(distance(fitted.positions[fitted.wire_frame().feature(id).vertices[0].vertex],
                       face.positions[feature(id).vertices[0].vertex]),
              kNear);
}

TEST(WireFrameFit, VerticesOfItsOwnLieOnTheFace) {
  const Geometry face = somebody(), fitted = fit_wire_frame(face, split_head());
  const std::vector<glm::ivec3> expected = with_middles(face.positions);
  for (std::size_t v = 0; v < expected.size(); ++v)
    EXPECT_LT(distance(fitted.positions[v], expected[v]), 0.05 * kUnitsPerEyeDistance) << v;
}

TEST(WireFrameFit, AFrameOfAnotherSizeIsScaled) {
  WireFrameTables tables = split_head_tables();
  for (glm::ivec3& p : tables.positions) p = p * 3 / 4 + glm::ivec3(100, -200, 300);
  const Geometry fitted = fit_wire_frame(toy_geometry(), make_wire_frame(tables).value());
  for (std::size_t k = 0; k < kLandmarkCount; ++k)
    EXPECT_LT(distance(fitted.positions[fitted.wire_frame().vertex_of_landmark(k)],
                       toy_geometry().positions[vertex_of_landmark(k)]),
              kNear)
        << k;
}

TEST(WireFrameFit, ThePayloadsAreThoseOfTheGeometry) {
  FaceStream face;
  face.geometry = somebody();
  const auto out = on_wire_frame(face, split_head());
  ASSERT_TRUE(out) << out.error().text;
  const auto frame = decode_wire_frame(out->wire_frame_payload);
  ASSERT_TRUE(frame);
  EXPECT_EQ(tables_of(**frame), split_head_tables());
  const auto geometry = decode_geometry(out->geometry_payload, *frame);
  ASSERT_TRUE(geometry);
  EXPECT_EQ(geometry->positions, out->geometry.positions);
}

}  // namespace
}  // namespace fbs
