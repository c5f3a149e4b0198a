// Images as PNG files in memory, through OpenImageIO. Part of the module fbs_image.
#pragma once

#include <cstdint>
#include <vector>

#include "cli/video/colour.h"
#include "common/result.h"

namespace fbs {

/// @param image  sRGB
Result<std::vector<std::uint8_t>> encode_png(const RgbImage& image);

}  // namespace fbs
