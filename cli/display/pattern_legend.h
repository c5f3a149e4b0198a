// The legend of a picture's patterns: their colours, and the weights of each in each region.
#pragma once

#include <opencv2/core.hpp>

#include "cli/stream/picture_sources.h"

namespace fbs::cli {

inline constexpr int kLegendWidth = 330;  ///< pixels

/// In BGR: the picture's number, how many patterns have arrived, those in the store, and for each region a
/// bar divided by its weights, with numbers and percentages below. Still patterns are hatched.
/// @param min_height  of the image; it is higher if the legend needs more
[[nodiscard]] cv::Mat pattern_legend(const PictureSources& sources, int min_height);

/// Position of a region's bar; its pixels show the weights from left to right.
[[nodiscard]] cv::Rect legend_bar(const PictureSources& sources, Region region);

}  // namespace fbs::cli
