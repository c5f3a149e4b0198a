#include "decoder/export/obj_model.h"

#include <array>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "decoder/export/head_pose_track.h"
#include "decoder/export/picture_frame.h"
#include "decoder/head/head_deformation.h"

namespace fbs {
namespace {

template <class... Numbers>
void append(std::string& out, const char* format, Numbers... numbers) {
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(), format, numbers...);
  out += text.data();
}

void append_faces(std::string& out, const std::vector<std::uint16_t>& corners) {
  for (std::size_t t = 0; t + 2 < corners.size(); t += 3) {
    out += "f";
    for (std::size_t k = 0; k < 3; ++k) {
      const int v = corners[t + k] + 1;  // counted from one
      append(out, " %d/%d/%d", v, v, v);
    }
    out += "\n";
  }
}

std::string name(std::string_view material, const char* part) {
  return std::string(material) + part;
}

}  // namespace

std::string obj_of(const RecordedHead& head, const State& state, double scale_of_first,
                   const VideoFormat& format, std::string_view library, std::string_view material) {
  const PictureFrame frame(format, scale_of_first);
  const ModelPose pose = model_pose(state);
  const HeadTriangles triangles = head_triangles(head);
  std::vector<glm::dvec3> vertices;
  for (const glm::dvec3& v : model_vertices({deform(head.geometry, state), head.geometry.own_frame}))
    vertices.push_back(frame.metres(pose.translation + pose.scale * (pose.rotation * v)));
  std::string out =
      "# fbs export: metres, y up, z towards the viewer\nmtllib " + std::string(library) + "\no head\n";
  for (const glm::dvec3& v : vertices) append(out, "v %.6f %.6f %.6f\n", v.x, v.y, v.z);
  for (const glm::dvec2& t : texture_coordinates(head, texture_area(head)))
    append(out, "vt %.6f %.6f\n", t.x, 1 - t.y);
  for (const glm::vec3& n : vertex_normals(vertices, triangles.face))
    append(out, "vn %.4f %.4f %.4f\n", n.x, n.y, n.z);
  out += "usemtl " + name(material, "_face") + "\n";
  append_faces(out, triangles.face);
  if (!triangles.mouth.empty()) {
    out += "usemtl " + name(material, "_mouth") + "\n";
    append_faces(out, triangles.mouth);
  }
  return out;
}

std::string mtl_of(const HeadLook& look, std::string_view texture, std::string_view material) {
  // One colour: OBJ has no vertex colours that all programs read.
  std::array<double, 3> mouth{};
  for (std::size_t c = 0; c < mouth.size(); ++c) mouth[c] = look.mouth[kInteriorMiddle][c] / 255.0;
  std::string out = "newmtl " + name(material, "_face") + "\nKa 1 1 1\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd " +
                    std::string(texture) + "\nnewmtl " + name(material, "_mouth") + "\n";
  append(out, "Ka %.4f %.4f %.4f\n", mouth[0], mouth[1], mouth[2]);
  append(out, "Kd %.4f %.4f %.4f\n", mouth[0], mouth[1], mouth[2]);
  return out + "Ks 0 0 0\nillum 1\n";
}

std::string obj_of_nobody() {
  return "# fbs export: this picture shows no head\n";
}

}  // namespace fbs
