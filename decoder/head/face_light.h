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

/// Light at a vertex: additions to luma, 1/16 grey level.
struct VertexLight {
  std::int32_t offset = 0;  ///< regardless of the luma
  std::int32_t gain = 0;    ///< for luma 64 levels brighter than 128
  friend bool operator==(const VertexLight&, const VertexLight&) = default;
};

/// Light at a point of the adapted head before control points displace it, head units.
[[nodiscard]] VertexLight light_at(glm::ivec3 point, const std::array<std::int32_t, kLightCount>& light);

/// Light at each vertex of a HeadMesh; empty when there is none. Zero on the ring: light ends there.
/// @param ring  number of the ring's vertices
[[nodiscard]] std::vector<VertexLight> vertex_lights(std::span<const glm::ivec3> positions, std::size_t ring,
                                                     const std::array<std::int32_t, kLightCount>& light);

}  // namespace fbs
