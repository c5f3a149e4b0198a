// What `fbs play` shows on the key p: which patterns the picture is drawn from, and where.
#pragma once

#include <opencv2/core.hpp>

#include "decoder/stream_decoder.h"

namespace fbs::cli {

/// The image, tinted by the colours of the patterns, with a legend on its right. Depends on its arguments
/// alone.
/// @param decoder  records its patterns
/// @param image    its current picture in BGR, enlarged or not
/// @return the image as it is when the decoder has no pattern
[[nodiscard]] Result<cv::Mat> pattern_overlay(const StreamDecoder& decoder, const cv::Mat& image);

}  // namespace fbs::cli
