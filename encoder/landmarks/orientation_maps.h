// Gradients of a picture, sorted by orientation into smoothed maps, for finding faces and landmarks. Method:
// Tola, Lepetit, Fua, DAISY, 2010.
#pragma once

#include <opencv2/core.hpp>
#include <span>

namespace fbs {

inline constexpr int kOrientations = 8;

/// How much of each orientation the gradients near a pixel have.
using Histogram = cv::Vec<float, kOrientations>;

/// Grey levels below which gradients are noise and are not scaled up to unit length.
inline constexpr float kNoiseGradient = 10;

/// Scales histograms to unit length, all together.
void scale_to_unit_length(std::span<float> histograms);

/// @param luma   grey levels
/// @param sigma  by which orientations are smoothed, pixels
/// @return a Histogram for each pixel
[[nodiscard]] cv::Mat orientation_maps(const cv::Mat1f& luma, float sigma);

}  // namespace fbs
