// The wire-frame packet: a mesh for the head of the scene in the place of the generic head. SPEC 4.8.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/result.h"
#include "common/wire_frame.h"

namespace fbs {

inline constexpr std::size_t kMaxWireFramePayload = 65536;  ///< bytes

/// @return kTooLarge  more than kMaxWireFramePayload bytes
[[nodiscard]] Result<std::vector<std::uint8_t>> encode_wire_frame(const WireFrame& frame);

/// @return kTooLarge       more than kMaxWireFramePayload bytes
///         kTruncated      the payload ends early
///         kInvalidStream  a number out of range, or tables that make_wire_frame() refuses
[[nodiscard]] Result<std::shared_ptr<const WireFrame>> decode_wire_frame(
    std::span<const std::uint8_t> payload);

}  // namespace fbs
