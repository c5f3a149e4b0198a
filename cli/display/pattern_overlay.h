// The overlay of `fbs play` on the key p: which patterns the picture is drawn from, and where.
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <optional>

#include "decoder/stream/stream_decoder.h"

namespace fbs::cli {

/// What a viewer draws of the decoder's scene.
struct DrawnState {
  const State& state;
  std::optional<std::size_t> pattern;  ///< if set, the only one; none: as in the state
};

/// The image, tinted by the colours of the patterns.
/// @param decoder  records its patterns
/// @param image    in BGR, enlarged or not
/// @return the image unchanged when the decoder has no pattern
[[nodiscard]] Result<cv::Mat> pattern_tinted(const StreamDecoder& decoder, const DrawnState& drawn,
                                             const cv::Mat& image);

/// The same with a legend on its right.
[[nodiscard]] Result<cv::Mat> pattern_overlay(const StreamDecoder& decoder, const DrawnState& drawn,
                                              const cv::Mat& image);

/// The image, tinted by the colours of the patterns, with a legend on its right. Depends on its arguments
/// alone.
/// @param decoder  records its patterns
/// @param image    its current picture in BGR, enlarged or not
/// @return the image unchanged when the decoder has no pattern
[[nodiscard]] Result<cv::Mat> pattern_overlay(const StreamDecoder& decoder, const cv::Mat& image);

}  // namespace fbs::cli
