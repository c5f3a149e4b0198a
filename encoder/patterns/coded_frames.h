// Cuts libaom's output into the content of pattern packets.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/result.h"

namespace fbs {

/// Cuts a temporal unit into one piece for each coded frame, shown or hidden, in coding order: its sequence
/// header if it has one, and the frame OBU without its size field. Temporal delimiters, padding, metadata and
/// headers that show an existing frame carry no picture of their own and are dropped.
/// @return kInternal when the unit is malformed or has other OBUs
Result<std::vector<std::vector<std::uint8_t>>> coded_frames(std::span<const std::uint8_t> temporal_unit);

}  // namespace fbs
