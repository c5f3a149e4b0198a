// What mouths do: the prior of lip shapes for the fit to the picture.
#pragma once

#include <opencv2/core.hpp>

namespace fbs {

/// Inverse covariance of the offsets of the lips' control points, per squared eye distance: a mouth opens,
/// stretches, smiles, rolls its lips and goes aside as a whole, and hardly does anything else. The actions are
/// those that MPEG-4 and CANDIDE name; their sizes were set by hand from how far lips go in speech.
/// Rows and columns: 2 * (control of the outer lips, then of the inner lips) + axis.
[[nodiscard]] const cv::Mat1d& mouth_precision();

}  // namespace fbs
