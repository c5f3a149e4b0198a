// The interface of the module fbs_matroska, which needs libmatroska to write and libwebm to read.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/result.h"

namespace fbs::cli {

inline constexpr const char* kMatroskaModule = "fbs_matroska";
inline constexpr const char* kStreamToMatroskaSymbol = "fbs_stream_to_matroska";
inline constexpr const char* kStreamOfMatroskaSymbol = "fbs_stream_of_matroska";

struct MatroskaFile {
  std::vector<std::uint8_t> bytes;
  bool sound_track = false;   ///< sound has its own track
  bool sound_inside = false;  ///< sound is within the video track
};

struct MatroskaStream {
  std::vector<std::uint8_t> bytes;
  std::vector<std::string> left_out;  ///< codec IDs of tracks that are not in it
};

/// Makes a file from which fbs_stream_of_matroska() restores the same stream, which has been verified.
/// @param application  WritingApp of the file
using StreamToMatroska = void(std::span<const std::uint8_t> stream, const std::string& application,
                              Result<MatroskaFile>& file);

using StreamOfMatroska = void(std::span<const std::uint8_t> file, Result<MatroskaStream>& stream);

}  // namespace fbs::cli
