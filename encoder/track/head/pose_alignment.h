// Aligns the head to its appearance in the first picture: direct alignment, as in Baker & Matthews 2004, but
// additive, since poses are not a group under weak perspective. Nothing drifts.
#pragma once

#include <opencv2/core.hpp>
#include <span>

#include "encoder/track/head/head_appearance.h"

namespace fbs {

/// Prior of a pose about its guess: inverse variances of its numbers. Affects only what the picture does not
/// determine.
/// @param sigma_angle  rad; of the scale, log2
/// @param sigma_shift  eye distances
[[nodiscard]] cv::Matx66d pose_precision(double eye_distance_px, double sigma_angle, double sigma_shift);

/// Gauss-Newton on the robust luma difference at one level, with gain and offset of the light.
/// @param points  HeadAppearance::surface() with the present expression
/// @return `start` when too little of the head is seen
[[nodiscard]] Pose align(const HeadAppearance& head, const LevelledFrame& now, int level, const Pose& start,
                         std::span<const glm::dvec3> points);

/// Aligns from the coarsest level on; skips a level that lowers the correlation.
[[nodiscard]] TrackedPose refine(const HeadAppearance& head, const LevelledFrame& now, const Pose& start,
                                 std::span<const glm::dvec3> points);

/// The pose without yaw and pitch, with the middle of the face in place: tried when those may be wrong.
[[nodiscard]] Pose frontal(const Pose& pose, const HeadVertices& vertices);

}  // namespace fbs
