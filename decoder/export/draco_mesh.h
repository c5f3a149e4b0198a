// A mesh in Draco's bitstream, for KHR_draco_mesh_compression.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "common/result.h"

namespace fbs {

/// Attributes of equal length.
struct MeshAttributes {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> texture;
};

struct DracoMesh {
  std::vector<std::uint8_t> bytes;
  std::map<std::string, int> attributes;  ///< unique ids by glTF's names: POSITION ...
};

/// Vertices and triangles keep their order, on which morph targets depend: sequential encoding.
/// @param position_step  of the grid that positions lie on, and which keeps them exact; normals get 10 bits,
///                       texture coordinates 14
[[nodiscard]] Result<DracoMesh> encode_draco_mesh(const MeshAttributes& mesh,
                                                  std::span<const std::uint16_t> corners,
                                                  double position_step);

}  // namespace fbs
