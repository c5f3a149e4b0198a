// Codes 105 integer points with Draco; the only file that uses Draco. SPEC 4.2.
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

/// Codes one int32 attribute of three components as a sequential point cloud, which keeps the order, with the
/// shorter of Draco's predictions "none" and "difference". Leaves out the first bytes of the Draco stream,
/// which are the same for every head.
/// @return kInternal  Draco fails, or writes another bitstream version
[[nodiscard]] Result<std::vector<std::uint8_t>> encode_points(const HeadPoints& points);

/// @return kInvalidStream  Draco cannot decode the bytes
///         kUnsupported    this processor has the high byte first, where Draco misreads its own streams
[[nodiscard]] Result<HeadPoints> decode_points(std::span<const std::uint8_t> bytes);

}  // namespace fbs
