// Reads Matroska files with a stream.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cli/matroska/matroska_content.h"
#include "common/result.h"

namespace fbs::cli {

struct ReadMatroska {
  MatroskaContent content;            ///< without sizes and durations, which the stream has
  std::vector<std::string> left_out;  ///< codec IDs of tracks that are not read
};

/// Takes the first video track with codec ID V_FBS, and the first with A_OPUS. Also reads files of other
/// writers: with lacing, with other units of time, and without cues.
/// @return kUnsupported    no V_FBS track, or one that is encrypted or compressed
///         kTruncated      an element is longer than the file
///         kInvalidStream  damaged
Result<ReadMatroska> read_matroska(std::span<const std::uint8_t> file);

}  // namespace fbs::cli
