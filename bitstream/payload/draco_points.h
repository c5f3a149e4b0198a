// Codes the points of a head with Draco; the only file that uses Draco. SPEC 4.2.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/result.h"

namespace fbs {

using HeadPoints = std::vector<glm::ivec3>;

/// Codes one int32 attribute of three components as a sequential point cloud, which keeps the order, with the
/// shorter of Draco's predictions "none" and "difference". Leaves out the first bytes of the Draco stream,
/// which follow from the number of points.
/// @param points  less than 65536
/// @return kInternal  Draco fails, or writes another bitstream version
[[nodiscard]] Result<std::vector<std::uint8_t>> encode_points(const HeadPoints& points);

/// @param count  number of points, which the bytes do not say; a wrong number may decode all the same
/// @return kInvalidStream  Draco cannot decode the bytes
///         kUnsupported    this processor has the high byte first, where Draco misreads its own streams
[[nodiscard]] Result<HeadPoints> decode_points(std::span<const std::uint8_t> bytes, std::size_t count);

}  // namespace fbs
