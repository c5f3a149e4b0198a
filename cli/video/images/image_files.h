// Image files through OpenImageIO, which may throw. Part of the module fbs_image.
#pragma once

#include <memory>
#include <string>

#include "cli/video/video_sink.h"
#include "cli/video/video_source.h"
#include "common/picture.h"
#include "common/result.h"

namespace fbs {

/// RGB becomes limited-range BT.601; grey is converted, more than 8 bits are dithered, transparent parts are
/// shown over black.
Result<std::unique_ptr<VideoSource>> open_image_source(const std::string& input,
                                                       const SourceOptions& options);

/// Pictures are numbered from 1 and named `NAME.part` until finish() renames them all.
Result<std::unique_ptr<VideoSink>> open_image_sink(const std::string& output, const VideoFormat& format);

/// Images of scene-linear light, such as OpenEXR's, get the transfer curve of sRGB; others count as sRGB.
/// Values beyond 0..1 are clamped, alpha is dropped.
/// @param format  of the video: its size, range and matrix
/// @return kIo, kInvalidStream for an image that cannot be read; kInvalidArgument for one of another size;
///         the text names the file
Result<Picture> read_still_image(const std::string& name, const VideoFormat& format);

}  // namespace fbs
