// Filters for the maps of the external energies. Lengths in snake units.
#pragma once

#include <opencv2/core.hpp>

namespace fbs {

/// Gaussian smoothing, the border mirrored. In place or not.
void smooth(const cv::Mat1f& in, cv::Mat1f& out, double sigma_units);

/// Central differences per snake unit, times `sign`; none across the border.
void slopes(const cv::Mat1f& values, float sign, cv::Mat1f& by_x, cv::Mat1f& by_y);

}  // namespace fbs
