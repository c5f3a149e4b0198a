// A picture patch of a feature, cut out in the head's own frame, so that it moves with the head.
#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "encoder/image/work_frame.h"
#include "encoder/model/pose.h"

namespace fbs {

/// Y, U and V, 8 bit, of one size; Y alone for a brow.
using FeaturePatch = std::array<cv::Mat, 3>;

/// Resolution of patches per snake unit: WorkFrame's 48 pixels per eye distance.
inline constexpr double kPatchPxPerUnit = 1.5;

/// A rectangle in a plane of the head frame parallel to the face.
struct PatchPlane {
  cv::Rect2d region{};  ///< snake units
  double depth = 0;     ///< z, head units
};

/// The part of a picture in the rectangle: the pose maps its plane to the picture affinely.
/// @param luma_only  leave the chroma planes empty
[[nodiscard]] FeaturePatch cut_patch(const WorkFrame& frame, const Pose& pose, const PatchPlane& plane,
                                     bool luma_only);

}  // namespace fbs
