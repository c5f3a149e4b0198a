// Codes a scene's patterns together, with look-ahead: a later one may be coded first and predict those before
// it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/picture.h"
#include "common/result.h"
#include "encoder/patterns/av1_encoder.h"

namespace fbs {

/// Limit of pictures in a sequence, all of which are in memory.
inline constexpr std::size_t kMaxSequencePictures = 512;

struct SequenceSettings {
  int quantiser = 40;  ///< libaom's scale, 0..63; for frames that no other refers to
  int speed = kSentSpeed;
  /// How many steps finer than `quantiser` frames that others refer to may be coded, above all the first.
  /// Without a bound (63) the first costs 10..25 % more bytes at quantiser 50, for no gain in the whole (four
  /// clips, 16 and 30 patterns).
  int boost = 20;
  bool reduced = false;  ///< code all pictures at half width and height
  int threads = 2;       ///< Av1Settings::threads
};

/// A pattern as coded and as shown.
struct SequencePattern {
  std::size_t picture = 0;        ///< index into the pictures, which are in display order
  std::vector<std::uint8_t> av1;  ///< one coded frame, as PatternDecoder reads it
  Picture decoded;                ///< full size
};

/// Codes pictures as one AV1 sequence.
/// @param pictures  1..kMaxSequencePictures, all of the format's size, in display order
/// @return one pattern for each picture, in coding order; the first is the key frame, of pictures[0]
Result<std::vector<SequencePattern>> code_pattern_sequence(const VideoFormat& format,
                                                           std::span<const Picture> pictures,
                                                           const SequenceSettings& settings);

}  // namespace fbs
