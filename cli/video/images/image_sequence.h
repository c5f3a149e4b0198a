// The files of an image sequence, in order. Part of the module fbs_image.
#pragma once

#include <string>
#include <vector>

#include "common/result.h"

namespace fbs {

/// @param input  `folder/frame_%05d.png`, a name with `*` or `?`, or a folder (all images in it)
/// @param is_image_suffix  called with "png", lower case and without dot; used for folders only
/// @return at least one path, ordered by the numbers in the names, then by name; ErrorCode::kIo when there is
/// none
Result<std::vector<std::string>> image_sequence_files(const std::string& input,
                                                      bool (*is_image_suffix)(const std::string&));

}  // namespace fbs
