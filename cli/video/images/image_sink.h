// Image sequences written through OpenImageIO. Part of the module fbs_image.
#pragma once

#include <memory>
#include <string>

#include "cli/video/video_sink.h"

namespace fbs {

/// Pictures are numbered from 1 and named `NAME.part` until finish() renames them all.
Result<std::unique_ptr<VideoSink>> open_image_sink(const std::string& output, const VideoFormat& format);

}  // namespace fbs
