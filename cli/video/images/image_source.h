// Image sequences read through OpenImageIO. Part of the module fbs_image.
#pragma once

#include <memory>
#include <string>

#include "cli/video/video_source.h"

namespace fbs {

/// RGB becomes limited-range BT.601, grey and more than 8 bits are converted, alpha is dropped.
Result<std::unique_ptr<VideoSource>> open_image_source(const std::string& input,
                                                       const SourceOptions& options);

}  // namespace fbs
