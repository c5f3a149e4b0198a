// One image as a picture of a video, through OpenImageIO. Part of the module fbs_image.
#pragma once

#include <string>

#include "common/picture.h"
#include "common/result.h"

namespace fbs {

/// Images of scene-linear light, such as OpenEXR's, get the transfer curve of sRGB; others count as sRGB.
/// Values beyond 0..1 are clamped, alpha is dropped.
/// @param format  of the video: its size, range and matrix
/// @return kIo, kInvalidStream for an image that cannot be read; kInvalidArgument for one of another size;
/// the
///         text names the file
Result<Picture> read_still_image(const std::string& name, const VideoFormat& format);

}  // namespace fbs
