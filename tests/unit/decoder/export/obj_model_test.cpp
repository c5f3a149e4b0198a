#include "decoder/export/obj_model.h"

#include <gtest/gtest.h>

#include <sstream>

#include "decoder/head/head_deformation.h"
#include "tests/unit/decoder/export/recorded_talk.h"

namespace fbs {
namespace {

struct Lines {
  std::vector<std::array<double, 3>> vertices;
  std::size_t texture = 0, normals = 0, faces = 0;
};

Lines parse(const std::string& text) {
  Lines out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      std::array<double, 3> v{};
      words >> v[0] >> v[1] >> v[2];
      out.vertices.push_back(v);
    }
    out.texture += kind == "vt" ? 1 : 0;
    out.normals += kind == "vn" ? 1 : 0;
    out.faces += kind == "f" ? 1 : 0;
  }
  return out;
}

TEST(ObjModel, HasTheVerticesOfThePictureInMetres) {
  HeadRecording recording;
  record(recording, toy_scene(noise_picture(160, 128, 1)), 6);
  const State state = talking(5);
  const std::string text = obj_of(recording.heads()[0], state, 32, recording.format(), "head.mtl", "head");
  const Lines lines = parse(text);
  ASSERT_EQ(lines.vertices.size(), 105U);
  EXPECT_EQ(lines.texture, 105U);
  EXPECT_EQ(lines.normals, 105U);
  EXPECT_EQ(lines.faces, generic_head().triangles.size());
  const auto expected = project_vertices(toy_geometry(), state);
  const double pixel = 0.063 / 32;
  for (std::size_t v = 0; v < lines.vertices.size(); ++v) {
    EXPECT_NEAR(lines.vertices[v][0] / pixel + 80, expected[v].x / 64.0, 0.05);
    EXPECT_NEAR(64 - lines.vertices[v][1] / pixel, expected[v].y / 64.0, 0.05);
  }
  EXPECT_NE(text.find("mtllib head.mtl\n"), std::string::npos);
  EXPECT_NE(text.find("usemtl head_mouth\n"), std::string::npos);
}

TEST(ObjModel, MaterialsNameTheTexture) {
  HeadLook look;
  look.mouth[1] = {255, 0, 51};
  const std::string text = mtl_of(look, "head.png", "head");
  EXPECT_NE(text.find("newmtl head_face\n"), std::string::npos);
  EXPECT_NE(text.find("map_Kd head.png\n"), std::string::npos);
  EXPECT_NE(text.find("Kd 1.0000 0.0000 0.2000\n"), std::string::npos);
}

}  // namespace
}  // namespace fbs
