// Converts libav's frames to our pictures. Part of the module fbs_av.
#pragma once

#include "cli/video/av/av_support.h"
#include "common/picture.h"
#include "common/result.h"

namespace fbs {

/// Copies 8-bit 4:2:0 and grey; converts everything else with swscale (bicubic, accurate rounding). YCbCr
/// keeps its range and matrix; RGB becomes limited-range BT.601.
class FramePicture {
 public:
  /// @return ErrorCode::kUnsupported when swscale does not know the pixel format
  Result<Picture> convert(const AVFrame& frame);

 private:
  AvScaler scaler_;  ///< for the last format seen
  AvFrame scaled_;
};

/// Range of the samples that convert() returns.
ColourRange colour_range(const AVFrame& frame);

/// Matrix of the samples that convert() returns; kUnspecified for BT.2020 and others that we have no name
/// for.
ColourMatrix colour_matrix(const AVFrame& frame);

}  // namespace fbs
