// Light on the face: what a state adds to luma at each vertex. SPEC 10.11. Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/generic_head.h"
#include "common/state.h"

namespace fbs {

/// What the light adds to luma at a vertex, 1/16 grey level.
struct VertexLight {
  std::int32_t offset = 0;  ///< whatever the luma
  std::int32_t gain = 0;    ///< to luma 64 levels brighter than 128
  friend bool operator==(const VertexLight&, const VertexLight&) = default;
};

/// At a point of the adapted head before control points displace it, head units.
[[nodiscard]] VertexLight light_at(glm::ivec3 point, const std::array<std::int32_t, kLightCount>& light);

/// At each vertex of a HeadMesh; empty when there is no light. Zero on the ring: light ends there.
/// @param ring  number of its vertices
[[nodiscard]] std::vector<VertexLight> vertex_lights(std::span<const glm::ivec3> positions, std::size_t ring,
                                                     const std::array<std::int32_t, kLightCount>& light);

}  // namespace fbs
