// How evidence is searched in a face's frame.
#pragma once

#include <functional>

#include "encoder/find/face_frame.h"
#include "encoder/find/find_tuning.h"

namespace fbs {

/// The place in [from, to] where `evidence` less a penalty for distance from `usual` is largest.
/// @param sigma  distance from the usual place that costs as much as `evidence` of one
[[nodiscard]] double search(double from, double to, double usual, double sigma,
                            const std::function<double(double)>& evidence);

[[nodiscard]] inline double search(const find_tuning::SearchRange& range, double usual,
                                   const std::function<double(double)>& evidence) {
  return search(usual - range.before, usual + range.after, usual, range.sigma, evidence);
}

/// Mean over [centre - half, centre + half].
[[nodiscard]] double mean_over(double centre, double half, const std::function<double(double)>& value);

/// That the face's border is at a place: a step of brightness or colour from left to right.
[[nodiscard]] double border_evidence(const FaceFrame& face, double x, double y);

}  // namespace fbs
