// Writes Matroska files (RFC 9559).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/matroska/matroska_content.h"
#include "common/result.h"

namespace fbs::cli {

/// Unit of times in a file, ns. A cluster lasts at most 32767 of them.
inline constexpr std::int64_t kMatroskaTick = 100'000;

/// The same content gives the same bytes. Clusters begin at each key block of the video, which the cues list.
/// @param application  WritingApp
/// @return kInternal when libmatroska fails
Result<std::vector<std::uint8_t>> write_matroska(const MatroskaContent& content,
                                                 const std::string& application);

}  // namespace fbs::cli
