// The prior of expressions for the fit to the picture.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <opencv2/core.hpp>

#include "common/generic_head.h"

namespace fbs {

/// Control points of lips and brows, which the prior covers: the first in the order of FeatureId.
inline constexpr std::size_t kExpressionControls = 26;

/// Inverse covariance of the offsets of the control points of lips and brows about rest, per squared eye
/// distance: a mouth opens, stretches, smiles, rolls its lips and moves as a whole; brows rise, frown and
/// tilt, mostly together; little else happens. The actions are those of MPEG-4's parameters and CANDIDE's
/// action units; their sizes were set by hand from speech.
/// Rows and columns: 2 * control point + axis, for control points 0 .. kExpressionControls - 1.
[[nodiscard]] const cv::Mat1d& expression_precision();

/// The most probable offsets (head units) given the tracked contours' offsets, each known to within some
/// hundredths of the eye distance: contrast shows motion only across a contour, so that the line of a closed
/// mouth may slide along itself unnoticed. Control points past kExpressionControls stay unchanged.
[[nodiscard]] std::array<glm::dvec2, kControlCount> most_probable(
    const std::array<glm::dvec2, kControlCount>& tracked);

}  // namespace fbs
