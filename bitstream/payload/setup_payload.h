// The setup packet: begins a scene and says in which terms the rest is written. SPEC 4.1.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/syntax.h"
#include "common/result.h"

namespace fbs {

inline constexpr int kGenericHeadId = 3;
inline constexpr std::uint32_t kMaxPicturesPerSecond = 1000;
inline constexpr std::int32_t kMaxStep = 65535;

/// Checks every bound of a setup.
/// @return kTooLarge          a side beyond kMaxPictureSize
///         kInvalidArgument   a side below kMinPictureSize; a rate of zero or beyond kMaxPicturesPerSecond; a
///                            denominator of zero; a step outside 1..kMaxStep; parts without the
///                            pose or beyond kAllParts; a range or matrix that has no name
[[nodiscard]] Result<void> check_setup(const Setup& setup);

/// @return the payload, about 20 bytes; the errors of check_setup
[[nodiscard]] Result<std::vector<std::uint8_t>> encode_setup(const Setup& setup);

/// Bytes behind the known fields are ignored: later versions of the writer may add some.
/// @return kUnsupported    another format version, or another generic head
///         kTruncated      the payload ends early
///         kTooLarge       a side beyond kMaxPictureSize
///         kInvalidStream  anything else that check_setup refuses
[[nodiscard]] Result<Setup> decode_setup(std::span<const std::uint8_t> payload);

}  // namespace fbs
