// Which pixels of the first picture's patch show a feature, and which show its surroundings.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "common/generic_head.h"

namespace fbs {

/// 8 bit, nonzero where it is.
struct FeatureMasks {
  cv::Mat inside;   ///< the feature
  cv::Mat outside;  ///< skin around it; empty for inner lips, whose surroundings say nothing
};

/// @param outline  the curve at rest, pixels of the patch
[[nodiscard]] FeatureMasks feature_masks(FeatureId id, const std::vector<cv::Point>& outline, cv::Size patch);

}  // namespace fbs
