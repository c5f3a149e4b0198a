// The setup packet: begins a scene and defines its format, steps and parts. SPEC 4.1.
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
/// @return kTooLarge          a side beyond kMaxPictureSize; more than kMaxPatterns; a position beyond
///                            kMaxStreamPictures or kMaxStreamTime
///         kInvalidArgument   a position that can_last() refuses; a side below kMinPictureSize; a rate of
///                            zero or beyond kMaxPicturesPerSecond; a denominator of zero; a step outside
///                            1..kMaxStep; parts without the pose or beyond kAllParts; an unknown range or
///                            matrix
[[nodiscard]] Result<void> check_setup(const Setup& setup);

/// @return the payload, 20 to 45 bytes; the errors of check_setup
[[nodiscard]] Result<std::vector<std::uint8_t>> encode_setup(const Setup& setup);

/// Bytes after the known fields are ignored: later writers may add some.
/// @return kUnsupported    another format version, or another generic head
///         kTruncated      the payload ends early
///         kTooLarge       as check_setup
///         kInvalidStream  anything else that check_setup refuses
[[nodiscard]] Result<Setup> decode_setup(std::span<const std::uint8_t> payload);

}  // namespace fbs
