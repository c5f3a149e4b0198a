// The cost to a viewer of misplaced lips and lids, beyond squared differences.
#pragma once

#include <opencv2/core.hpp>

namespace fbs {

/// Quadratic added to a picture's cost, over the numbers of a coded state, kParameterCount x kParameterCount.
/// Zero for everything but the expression.
/// @param lambda  squared luma levels that a bit is worth
[[nodiscard]] cv::Mat1d expression_penalty(double lambda);

}  // namespace fbs
