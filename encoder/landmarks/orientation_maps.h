// Gradients of a picture, sorted by their orientation into maps that are smoothed: what faces are found and
// landmarks are searched by. Method: Tola, Lepetit, Fua, DAISY, 2010.
#pragma once

#include <opencv2/core.hpp>
#include <span>

namespace fbs {

inline constexpr int kOrientations = 8;

/// Of the gradients near a pixel: how much of each orientation there is.
using Histogram = cv::Vec<float, kOrientations>;

/// Below this, in grey levels, gradients are noise: they are not scaled up to unit length.
inline constexpr float kNoiseGradient = 10;

/// Scales histograms that belong together to unit length, all of them.
void scale_to_unit_length(std::span<float> histograms);

/// @param luma   grey levels
/// @param sigma  by which orientations are spread, pixels
/// @return a Histogram for each pixel
[[nodiscard]] cv::Mat orientation_maps(const cv::Mat1f& luma, float sigma);

}  // namespace fbs
