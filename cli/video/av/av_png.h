// PNG files in memory. Part of the module fbs_av.
#pragma once

#include <cstdint>
#include <vector>

#include "cli/video/colour.h"
#include "common/result.h"

namespace fbs {

/// @param width, height  of the file, in pixels: the image is scaled where they are not its own
Result<std::vector<std::uint8_t>> encode_png(const RgbImage& image, int width, int height);

}  // namespace fbs
