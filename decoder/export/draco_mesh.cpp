#include "decoder/export/draco_mesh.h"

#include <draco/compression/expert_encode.h>
#include <draco/core/encoder_buffer.h>
#include <draco/mesh/mesh.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <exception>

namespace fbs {
namespace {

constexpr int kNormalBits = 10, kTextureBits = 14;

template <class Vector>
int add_attribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type, const std::vector<Vector>& values) {
  draco::GeometryAttribute layout;
  layout.Init(type, nullptr, Vector::length(), draco::DT_FLOAT32, false, sizeof(Vector), 0);
  const int id = mesh.AddAttribute(layout, true, static_cast<std::uint32_t>(values.size()));
  for (std::uint32_t i = 0; i < values.size(); ++i)
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &values[i]);
  return id;
}

/// A cube that holds all positions and whose grid of 2^bits points per side has exactly `step`.
void keep_positions(draco::ExpertEncoder& encoder, int attribute, const std::vector<glm::vec3>& positions,
                    double step) {
  glm::vec3 low = positions.front(), high = low;
  for (const glm::vec3& p : positions) {
    low = glm::vec3(std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z));
    high = glm::vec3(std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z));
  }
  const double extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  const auto steps = static_cast<std::uint32_t>(std::ceil(extent / step));
  const int bits = std::max(static_cast<int>(std::bit_width(steps)), 1);
  encoder.SetAttributeExplicitQuantization(
      attribute, bits, 3, &low.x, static_cast<float>(((1U << static_cast<unsigned>(bits)) - 1) * step));
}

Result<DracoMesh> encode(const MeshAttributes& attributes, std::span<const std::uint16_t> corners,
                         double position_step) {
  draco::Mesh mesh;
  mesh.set_num_points(static_cast<std::uint32_t>(attributes.positions.size()));
  const int position = add_attribute(mesh, draco::GeometryAttribute::POSITION, attributes.positions);
  const int normal = add_attribute(mesh, draco::GeometryAttribute::NORMAL, attributes.normals);
  const int texture = add_attribute(mesh, draco::GeometryAttribute::TEX_COORD, attributes.texture);
  for (std::size_t t = 0; t + 2 < corners.size(); t += 3)
    mesh.AddFace({draco::PointIndex(corners[t]), draco::PointIndex(corners[t + 1]),
                  draco::PointIndex(corners[t + 2])});

  draco::ExpertEncoder encoder(mesh);
  encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
  encoder.SetSpeedOptions(0, 0);
  keep_positions(encoder, position, attributes.positions, position_step);
  encoder.SetAttributeQuantization(normal, kNormalBits);
  encoder.SetAttributeQuantization(texture, kTextureBits);
  draco::EncoderBuffer buffer;
  if (const auto status = encoder.EncodeToBuffer(&buffer); !status.ok())
    return fail(ErrorCode::kInternal, "Draco cannot encode the mesh: " + status.error_msg_string());
  const auto id = [&](int attribute) { return static_cast<int>(mesh.attribute(attribute)->unique_id()); };
  return DracoMesh{{buffer.data(), buffer.data() + buffer.size()},
                   {{"POSITION", id(position)}, {"NORMAL", id(normal)}, {"TEXCOORD_0", id(texture)}}};
}

}  // namespace

Result<DracoMesh> encode_draco_mesh(const MeshAttributes& mesh, std::span<const std::uint16_t> corners,
                                    double position_step) try {
  return encode(mesh, corners, position_step);
} catch (const std::exception& problem) {
  return fail(ErrorCode::kInternal, std::string("Draco cannot encode the mesh: ") + problem.what());
}

}  // namespace fbs
