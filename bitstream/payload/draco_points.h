// 105 integer points in and out of Draco: the only file that knows Draco. SPEC 4.2.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/generic_head.h"
#include "common/result.h"

namespace fbs {

using HeadPoints = std::array<glm::ivec3, kVertexCount>;

/// Draco's sequential point cloud coding, which keeps the order, of one int32 attribute of three components;
/// the shorter of Draco's predictions "none" and "difference". The first bytes of a Draco stream, the same
/// for every head, are left out.
/// @return kInternal  Draco refuses, or writes another version of its format
[[nodiscard]] Result<std::vector<std::uint8_t>> encode_points(const HeadPoints& points);

/// @return kInvalidStream  Draco refuses the bytes
[[nodiscard]] Result<HeadPoints> decode_points(std::span<const std::uint8_t> bytes);

}  // namespace fbs
