// The geometry packet: the adapted head as residuals to the scaled wire-frame, coded by Draco. SPEC 4.2.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "bitstream/syntax.h"
#include "common/result.h"

namespace fbs {

inline constexpr std::size_t kMaxGeometryPayload = 8192;                ///< bytes
inline constexpr std::int32_t kDefaultGeometryStep = 16;                ///< 1/256 eye distance
inline constexpr std::int32_t kMaxGeometryStep = kUnitsPerEyeDistance;  ///< head units

/// The payload, and the head that a decoder reconstructs from it.
struct CodedGeometry {
  std::vector<std::uint8_t> payload;
  Geometry decoded;  ///< each coordinate within step / 2 of the source
};

/// Scales the wire-frame to fit by least squares for each axis, quantises the residuals, and codes them
/// with the prediction that gives the shortest payload.
/// @param step  size of a residual step, head units, 1..kMaxGeometryStep
/// @return kInvalidArgument  number of positions other than number of vertices, a coordinate beyond
///                           kMaxCoordinate, or step out of range
[[nodiscard]] Result<CodedGeometry> encode_geometry(const Geometry& geometry,
                                                    std::int32_t step = kDefaultGeometryStep);

/// Whether a head has no depth: it is then a plane that moves the picture, not a face.
[[nodiscard]] bool is_flat(const Geometry& geometry);

/// @param own_frame  the scene's own; null: the generic head. A payload for a wire-frame with another number
///                   of vertices may decode all the same
/// @return kTooLarge       more than kMaxGeometryPayload bytes
///         kTruncated      the payload ends inside its header
///         kInvalidStream  Draco cannot decode the bytes, or a coordinate lies beyond kMaxCoordinate
[[nodiscard]] Result<Geometry> decode_geometry(std::span<const std::uint8_t> payload,
                                               std::shared_ptr<const WireFrame> own_frame = nullptr);

}  // namespace fbs
