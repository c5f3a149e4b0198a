// Reads generic_head.gltf and writes generic_head_table.cpp beside it: build target `head_table`, run after a
// change of the head. Copies integers and changes only the axes: the file has y up, z toward the viewer and
// counter-clockwise fronts; the table y down, z away and clockwise fronts.
#include <tiny_gltf.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace {

using tinygltf::Model;
using tinygltf::Value;

constexpr int kVertexCount = 105;
constexpr int kUnitsPerEyeDistance = 4096;

/// The bytes of one accessor, or nothing when its type is not the one our script writes.
const unsigned char* accessor_data(const Model& model, int index, int component_type, int type) {
  const tinygltf::Accessor& accessor = model.accessors.at(static_cast<std::size_t>(index));
  if (accessor.componentType != component_type || accessor.type != type) return nullptr;
  const tinygltf::BufferView& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
  return model.buffers.at(static_cast<std::size_t>(view.buffer)).data.data() + view.byteOffset +
         accessor.byteOffset;
}

/// Vertex positions in the head frame; nothing when a coordinate is not a whole number of units.
std::optional<std::vector<std::array<int, 3>>> read_positions(const Model& model) {
  const int index = model.meshes.at(0).primitives.at(0).attributes.at("POSITION");
  const unsigned char* bytes = accessor_data(model, index, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
  if (bytes == nullptr || model.accessors.at(static_cast<std::size_t>(index)).count != kVertexCount)
    return {};
  std::vector<std::array<int, 3>> positions(kVertexCount);
  for (std::array<int, 3>& position : positions) {
    for (std::size_t axis = 0; axis < 3; ++axis, bytes += sizeof(float)) {
      float value = 0;
      std::memcpy(&value, bytes, sizeof value);
      value *= kUnitsPerEyeDistance;
      if (value != std::nearbyint(value)) return {};
      position[axis] = static_cast<int>(axis == 0 ? value : -value);
    }
  }
  return positions;
}

std::vector<std::array<int, 3>> read_triangles(const Model& model) {
  const int index = model.meshes.at(0).primitives.at(0).indices;
  const unsigned char* bytes =
      accessor_data(model, index, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_SCALAR);
  if (bytes == nullptr) return {};
  std::vector<std::array<int, 3>> triangles(model.accessors.at(static_cast<std::size_t>(index)).count / 3);
  for (std::array<int, 3>& triangle : triangles) {
    std::array<std::uint16_t, 3> corner{};
    std::memcpy(corner.data(), bytes, sizeof corner);
    bytes += sizeof corner;
    triangle = {corner[0], corner[2], corner[1]};
  }
  return triangles;
}

int number(const Value& object, const char* key) {
  return object.Get(key).GetNumberAsInt();
}
int number(const Value& pair, int index) {
  return pair.Get(index).GetNumberAsInt();
}
int length(const Value& array) {
  return static_cast<int>(array.ArrayLen());
}

void write_vertices(std::ostream& out, const Value& vertices,
                    const std::vector<std::array<int, 3>>& positions) {
  out << "constexpr std::array<HeadVertex, kVertexCount> kVertices{{\n";
  for (int v = 0; v < kVertexCount; ++v) {
    const Value& vertex = vertices.Get(v);
    const std::array<int, 3>& p = positions[v];
    out << "    {\"" << vertex.Get("name").Get<std::string>() << "\", {" << p[0] << ", " << p[1] << ", "
        << p[2] << "}, " << number(vertex, "mirror") << ", " << number(vertex, "landmark") << ", "
        << number(vertex, "feature") << "},\n";
  }
  out << "}};\n\n";
}

void write_triangles(std::ostream& out, const std::vector<std::array<int, 3>>& triangles) {
  out << "constexpr std::array<HeadTriangle, " << triangles.size() << "> kTriangles{{\n";
  for (const std::array<int, 3>& t : triangles) {
    out << "    {" << t[0] << ", " << t[1] << ", " << t[2] << "},\n";
  }
  out << "}};\n\n";
}

void write_outline(std::ostream& out, const Value& outline) {
  out << "constexpr std::array<std::uint16_t, " << length(outline) << "> kOutline{";
  for (int i = 0; i < length(outline); ++i) out << (i > 0 ? ", " : "") << number(outline, i);
  out << "};\n\n";
}

/// kLandmarkVertex, the inverse of HeadVertex::landmark.
void write_landmarks(std::ostream& out, const Value& vertices) {
  std::array<int, 68> vertex_of{};
  for (int v = 0; v < kVertexCount; ++v) {
    const int landmark = number(vertices.Get(v), "landmark");
    if (landmark >= 0) vertex_of.at(static_cast<std::size_t>(landmark)) = v;
  }
  out << "constexpr std::array<std::uint16_t, kLandmarkCount> kLandmarkVertex{";
  for (std::size_t i = 0; i < vertex_of.size(); ++i) out << (i > 0 ? ", " : "") << vertex_of[i];
  out << "};\n\n";
}

void write_features(std::ostream& out, const Value& features) {
  for (int f = 0; f < length(features); ++f) {
    const Value& points = features.Get(f).Get("vertices_s12");
    out << "constexpr std::array<FeatureVertex, " << length(points) << "> kFeature" << f << "{{";
    for (int i = 0; i < length(points); ++i) {
      out << (i > 0 ? ", " : "") << "{" << number(points.Get(i), 0) << ", " << number(points.Get(i), 1)
          << ".0F / 12}";
    }
    out << "}};\n";
  }
  out << "\nconstexpr std::array<Feature, kFeatureCount> kFeatures{{\n";
  for (int f = 0; f < length(features); ++f) {
    const Value& feature = features.Get(f);
    out << "    {\"" << feature.Get("name").Get<std::string>() << "\", "
        << (feature.Get("closed").Get<bool>() ? "true" : "false") << ", " << number(feature, "first_control")
        << ", " << number(feature, "control_count") << ", kFeature" << f << "},\n";
  }
  out << "}};\n\n";
}

void write_skinning(std::ostream& out, const Value& vertices) {
  std::ostringstream weights;
  int count = 0;
  out << "constexpr std::array<std::uint16_t, kVertexCount + 1> kSkinningBegin{";
  for (int v = 0; v < kVertexCount; ++v) {
    const Value& row = vertices.Get(v).Get("skinning");
    out << count << ", ";
    for (int i = 0; i < length(row); ++i) {
      weights << "    {" << number(row.Get(i), 0) << ", " << number(row.Get(i), 1) << "},\n";
    }
    count += length(row);
  }
  out << count << "};\n\n";
  out << "constexpr std::array<SkinningWeight, " << count << "> kSkinning{{\n" << weights.str() << "}};\n\n";
}

void write_expression(std::ostream& out, const Value& parts) {
  for (int p = 0; p < length(parts); ++p) {
    const Value& rows = parts.Get(p).Get("rows");
    out << "constexpr std::array<std::int16_t, " << length(rows) * length(rows) << "> kRows" << p << "{{\n";
    for (int r = 0; r < length(rows); ++r) {
      for (int c = 0; c < length(rows); ++c) out << (c > 0 ? ", " : "    ") << number(rows.Get(r), c);
      out << ",\n";
    }
    out << "}};\n\n";
  }
  out << "constexpr std::array<ExpressionPart, kExpressionPartCount> kExpression{{\n";
  for (int p = 0; p < length(parts); ++p) {
    const Value& part = parts.Get(p);
    out << "    {\"" << part.Get("name").Get<std::string>() << "\", " << number(part, "first_control") << ", "
        << number(part, "control_count") << ", kRows" << p << "},\n";
  }
  out << "}};\n\n";
}

bool write_table(std::ostream& out, const Model& model) {
  const auto positions = read_positions(model);
  const auto triangles = read_triangles(model);
  const Value& extras = model.meshes.at(0).extras;
  const Value& vertices = extras.Get("vertices");
  if (!positions || triangles.empty() || length(vertices) != kVertexCount) return false;
  out << "// Made from generic_head.gltf by head_table_tool. Do not edit.\n"
         "// clang-format off\n"
         "#include \"common/generic_head.h\"\n\nnamespace fbs {\nnamespace {\n\n";
  write_vertices(out, vertices, *positions);
  write_triangles(out, triangles);
  write_outline(out, extras.Get("outline"));
  write_landmarks(out, vertices);
  write_features(out, extras.Get("features"));
  write_skinning(out, vertices);
  write_expression(out, extras.Get("expression"));
  out << "constinit const GenericHead kHead{{kVertices, kTriangles, kOutline, kFeatures, kSkinningBegin, "
         "kSkinning,\n"
         "                         kLandmarkVertex, kHeadAtlas},\n"
         "                        kExpression};\n\n"
         "}  // namespace\n\n"
         "const GenericHead& generic_head() { return kHead; }\n\n"
         "}  // namespace fbs\n";
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: head_table_tool generic_head.gltf generic_head_table.cpp\n";
    return 2;
  }
  Model model;
  std::string error;
  std::string warning;
  if (!tinygltf::TinyGLTF().LoadASCIIFromFile(&model, &error, &warning, argv[1])) {
    std::cerr << argv[1] << ": " << error << '\n';
    return 1;
  }
  std::ostringstream table;
  if (!write_table(table, model)) {
    std::cerr << argv[1] << ": not a generic head: 105 vertices on whole units and their extras expected\n";
    return 1;
  }
  std::ofstream out(argv[2], std::ios::binary);
  out << table.str();
  out.close();
  if (!out) std::cerr << argv[2] << ": cannot write\n";
  return out ? 0 : 1;
}
