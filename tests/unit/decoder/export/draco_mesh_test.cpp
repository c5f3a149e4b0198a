#include "decoder/export/draco_mesh.h"

#include <draco/compression/decode.h>
#include <gtest/gtest.h>

#include "decoder/export/head_look.h"
#include "decoder/export/head_pose_track.h"
#include "tests/unit/decoder/export/recorded_talk.h"

namespace fbs {
namespace {

TEST(DracoMesh, KeepsOrderAndPositionsExactly) {
  const Geometry head = toy_geometry();
  std::vector<std::uint16_t> corners;
  for (const HeadTriangle& t : generic_head().triangles) corners.insert(corners.end(), t.begin(), t.end());
  const auto vertices = model_vertices(head);
  const MeshAttributes mesh{{vertices.begin(), vertices.end()},
                            vertex_normals(vertices, corners),
                            std::vector<glm::vec2>(vertices.size(), {0.25F, 0.5F})};
  const auto coded = encode_draco_mesh(mesh, corners, 1.0 / kUnitsPerEyeDistance);
  ASSERT_TRUE(coded) << coded.error().text;
  const std::size_t plain =
      vertices.size() * (3 + 3 + 2) * sizeof(float) + corners.size() * sizeof(std::uint16_t);
  EXPECT_LT(coded->bytes.size(), plain / 2);

  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(coded->bytes.data()), coded->bytes.size());
  auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
  ASSERT_TRUE(decoded.ok());
  const draco::Mesh& out = *decoded.value();
  ASSERT_EQ(out.num_points(), vertices.size());
  ASSERT_EQ(out.num_faces() * 3, corners.size());
  for (std::uint32_t t = 0; t < out.num_faces(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(out.face(draco::FaceIndex(t))[k].value(), corners[3 * t + k]);
  const auto* positions =
      out.GetAttributeByUniqueId(static_cast<std::uint32_t>(coded->attributes.at("POSITION")));
  ASSERT_NE(positions, nullptr);
  for (std::uint32_t v = 0; v < out.num_points(); ++v) {
    glm::vec3 p;
    positions->GetMappedValue(draco::PointIndex(v), &p);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(p[axis], vertices[v][axis], 1e-6) << "vertex " << v;
  }
}

}  // namespace
}  // namespace fbs
