#include "decoder/export/gltf_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "decoder/export/draco_mesh.h"
#include "decoder/head/mouth_interior.h"

namespace fbs {
namespace {

constexpr const char* kDraco = "KHR_draco_mesh_compression";
constexpr const char* kUnlit = "KHR_materials_unlit";

void use_extension(tinygltf::Model& model, const char* name, bool required) {
  for (auto* list : {&model.extensionsUsed, required ? &model.extensionsRequired : nullptr})
    if (list != nullptr && std::find(list->begin(), list->end(), name) == list->end())
      list->emplace_back(name);
}

/// A material with the picture's own colours, whatever light a viewer has.
int add_material(tinygltf::Model& model, const std::string& name, int texture) {
  tinygltf::Material material;
  material.name = name;
  material.doubleSided = true;
  material.pbrMetallicRoughness.metallicFactor = 0;
  material.pbrMetallicRoughness.baseColorTexture.index = texture;
  material.extensions[kUnlit] = tinygltf::Value(tinygltf::Value::Object());
  use_extension(model, kUnlit, false);
  model.materials.push_back(material);
  return static_cast<int>(model.materials.size()) - 1;
}

int add_texture(tinygltf::Model& model, GltfBuffer& buffer, const HeadLook& look, const std::string& name) {
  tinygltf::Image image;
  image.name = name;
  image.mimeType = "image/png";
  image.bufferView = buffer.add_view(look.png);
  model.images.push_back(image);
  tinygltf::Sampler sampler;
  sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
  sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
  sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
  model.samplers.push_back(sampler);
  tinygltf::Texture texture;
  texture.source = static_cast<int>(model.images.size()) - 1;
  texture.sampler = static_cast<int>(model.samplers.size()) - 1;
  model.textures.push_back(texture);
  return static_cast<int>(model.textures.size()) - 1;
}

std::vector<glm::vec3> floats_of(const std::vector<glm::dvec3>& v) {
  return {v.begin(), v.end()};
}

/// IEC 61966-2-1; vertex colours are linear.
float linear(std::uint8_t srgb) {
  const double v = srgb / 255.0;
  return static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
}

std::vector<std::map<std::string, int>> add_targets(GltfBuffer& buffer, const HeadMorphs& morphs,
                                                    const std::vector<std::uint16_t>& vertices) {
  std::vector<std::map<std::string, int>> out;
  int still = -1;  // one accessor for all targets that move nothing here
  for (const MorphTarget& target : morphs.targets()) {
    std::vector<glm::vec3> moved;
    moved.reserve(vertices.size());
    for (const std::uint16_t v : vertices) moved.emplace_back(target.displacements[v]);
    const bool moves =
        std::any_of(moved.begin(), moved.end(), [](const glm::vec3& d) { return d != glm::vec3(0); });
    if (!moves && still < 0) still = buffer.add_displacements(moved);
    out.push_back({{"POSITION", moves ? buffer.add_displacements(moved) : still}});
  }
  return out;
}

/// Encodes the attributes of a primitive and its indices with Draco.
Result<void> compress(tinygltf::Model& model, GltfBuffer& buffer, const MeshAttributes& mesh,
                      const std::vector<std::uint16_t>& corners, tinygltf::Primitive& primitive) {
  auto draco = encode_draco_mesh(mesh, corners, 1.0 / kUnitsPerEyeDistance);
  if (!draco) return fail(draco.error());
  const std::size_t n = mesh.positions.size();
  primitive.indices =
      buffer.add_absent(corners.size(), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_SCALAR);
  for (const auto& [name, type] : {std::pair{"POSITION", TINYGLTF_TYPE_VEC3},
                                   {"NORMAL", TINYGLTF_TYPE_VEC3},
                                   {"TEXCOORD_0", TINYGLTF_TYPE_VEC2}})
    primitive.attributes[name] = buffer.add_absent(n, TINYGLTF_COMPONENT_TYPE_FLOAT, type);
  buffer.set_bounds(primitive.attributes["POSITION"], mesh.positions);
  tinygltf::Value::Object ids;
  for (const auto& [name, id] : draco->attributes) ids[name] = tinygltf::Value(id);
  primitive.extensions[kDraco] =
      tinygltf::Value(tinygltf::Value::Object{{"bufferView", tinygltf::Value(buffer.add_view(draco->bytes))},
                                              {"attributes", tinygltf::Value(std::move(ids))}});
  use_extension(model, kDraco, true);
  return {};
}

Result<tinygltf::Primitive> face_primitive(tinygltf::Model& model, GltfBuffer& buffer,
                                           const RecordedHead& head, const HeadMorphs& morphs,
                                           const std::vector<std::uint16_t>& corners, bool draco) {
  const auto vertices = model_vertices(head.geometry);
  MeshAttributes mesh{floats_of(vertices), vertex_normals(vertices, corners), {}};
  for (const glm::dvec2& t : texture_coordinates(head, texture_area(head))) mesh.texture.emplace_back(t);
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  if (draco) {
    if (auto done = compress(model, buffer, mesh, corners, primitive); !done) return fail(done.error());
  } else {
    primitive.indices = buffer.add_indices(corners);
    primitive.attributes = {{"POSITION", buffer.add_vectors(mesh.positions, true)},
                            {"NORMAL", buffer.add_vectors(mesh.normals, false)},
                            {"TEXCOORD_0", buffer.add_vectors(mesh.texture)}};
  }
  std::vector<std::uint16_t> all(vertices.size());
  std::iota(all.begin(), all.end(), std::uint16_t{0});
  primitive.targets = add_targets(buffer, morphs, all);
  return primitive;
}

/// The triangles between the lips with vertices of their own, whose colours run from the upper lip's to the
/// lower's as in the decoder.
tinygltf::Primitive mouth_primitive(GltfBuffer& buffer, const RecordedHead& head, const HeadLook& look,
                                    const HeadMorphs& morphs, const std::vector<std::uint16_t>& corners) {
  std::vector<std::uint16_t> vertices(corners);
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const auto all = model_vertices(head.geometry);
  std::vector<glm::vec3> positions, colours;
  for (const std::uint16_t v : vertices) {
    positions.emplace_back(all[v]);
    const auto place =
        static_cast<std::size_t>(2 * mouth_ramp(head.geometry.wire_frame(), v) / kMouthRampEnd);
    const Srgb& srgb = look.mouth[place];
    const glm::vec3 colour(linear(srgb[0]), linear(srgb[1]), linear(srgb[2]));
    colours.push_back(colour);
  }
  std::vector<std::uint16_t> own;
  own.reserve(corners.size());
  for (const std::uint16_t v : corners)
    own.push_back(
        static_cast<std::uint16_t>(std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin()));
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.indices = buffer.add_indices(own);
  primitive.attributes = {{"POSITION", buffer.add_vectors(positions, true)},
                          {"COLOR_0", buffer.add_vectors(colours, false)}};
  primitive.targets = add_targets(buffer, morphs, vertices);
  return primitive;
}

tinygltf::Value names_of(const HeadMorphs& morphs) {
  tinygltf::Value::Array names;
  for (const MorphTarget& t : morphs.targets()) names.emplace_back(t.name);
  return tinygltf::Value(tinygltf::Value::Object{{"targetNames", tinygltf::Value(std::move(names))}});
}

}  // namespace

Result<int> add_head_mesh(tinygltf::Model& model, GltfBuffer& buffer, const RecordedHead& head,
                          const HeadLook& look, const HeadMorphs& morphs, const std::string& name,
                          bool draco) {
  const HeadTriangles triangles = head_triangles(head);
  auto face = face_primitive(model, buffer, head, morphs, triangles.face, draco);
  if (!face) return fail(face.error());
  face->material = add_material(model, name + "_face", add_texture(model, buffer, look, name + "_pattern"));
  tinygltf::Mesh mesh;
  mesh.name = name;
  mesh.primitives.push_back(*face);
  if (!triangles.mouth.empty()) {
    mesh.primitives.push_back(mouth_primitive(buffer, head, look, morphs, triangles.mouth));
    mesh.primitives.back().material = add_material(model, name + "_mouth", -1);
  }
  mesh.weights = morphs.weights(head.states.front().state);
  mesh.extras = names_of(morphs);
  model.meshes.push_back(mesh);
  return static_cast<int>(model.meshes.size()) - 1;
}

}  // namespace fbs
