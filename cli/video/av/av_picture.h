// Converts libav's frames to our pictures. Part of the module fbs_av.
#pragma once

#include "cli/video/av/av_support.h"
#include "common/picture.h"
#include "common/result.h"

namespace fbs {

/// Copies 8-bit 4:2:0 and grey; converts everything else with swscale (bicubic, accurate rounding),
/// which dithers more than 8 bits. YCbCr keeps its range and matrix; RGB becomes limited-range BT.601.
/// Transparent parts are shown over black.
class FramePicture {
 public:
  /// @return ErrorCode::kUnsupported when swscale does not know the pixel format
  Result<Picture> convert(const AVFrame& frame);

  /// Whether any frame had a part that is not opaque.
  [[nodiscard]] bool was_transparent() const { return was_transparent_; }

 private:
  void put_over_black(Picture& picture, const Plane& alpha, ColourRange range);

  AvScaler scaler_;  ///< for the last format seen
  AvFrame scaled_;
  bool was_transparent_ = false;
};

/// Range of the samples that convert() returns.
ColourRange colour_range(const AVFrame& frame);

/// Matrix of the samples that convert() returns; kUnspecified for those that we have no name for. (BT.2020
/// is converted before: av_colour.h.)
ColourMatrix colour_matrix(const AVFrame& frame);

}  // namespace fbs
