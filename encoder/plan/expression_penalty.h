// What lips and lids that are out of place cost a viewer, beyond what squared differences say.
#pragma once

#include <opencv2/core.hpp>

namespace fbs {

/// Quadratic over the numbers of a coded state, kParameterCount x kParameterCount, that is added to a
/// picture's cost. Zero for everything but the expression.
/// @param lambda  squared luma levels that a bit is worth
[[nodiscard]] cv::Mat1d expression_penalty(double lambda);

}  // namespace fbs
