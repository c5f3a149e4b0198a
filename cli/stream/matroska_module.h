// The interface of the module fbs_matroska: it needs libmatroska, which writes, and libwebm, which reads.
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
  bool sound_track = false;   ///< its sound is a track of its own
  bool sound_inside = false;  ///< its sound is within the video track
};

struct MatroskaStream {
  std::vector<std::uint8_t> bytes;
  std::vector<std::string> left_out;  ///< codec IDs of tracks that are not in it
};

/// A file out of which fbs_stream_of_matroska() makes the same stream again: that has been tried.
/// @param application  WritingApp of the file
using StreamToMatroska = void(std::span<const std::uint8_t> stream, const std::string& application,
                              Result<MatroskaFile>& file);

using StreamOfMatroska = void(std::span<const std::uint8_t> file, Result<MatroskaStream>& stream);

}  // namespace fbs::cli
