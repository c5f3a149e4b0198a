// What the analysis believes of a picture: the state in continuous numbers, and how surely it is known.
#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "encoder/model/expression_basis.h"
#include "encoder/model/pose.h"

namespace fbs {

/// Pose, light and the mouth's inside (grey levels, else as in State), offsets of all control points (head
/// units).
struct Fit {
  Pose pose;
  std::array<double, kLightCount> light{};
  std::array<double, kInteriorCount> interior{};
  Offsets offsets{};
};

/// The state nearest to a fit; body and ground stay where pattern 0 saw them.
[[nodiscard]] State state_of(const Fit& fit);

/// What a picture says of its state: the squared luma difference over the face, in samples of the full
/// picture, rises from the fit's by (x - fit)^T form (x - fit), x the numbers of the coded state in the units
/// of State and in head units. Rows and columns of body and ground are zero.
struct FitForm {
  std::array<double, kParameterCount> value{};
  cv::Mat1d form;  ///< kParameterCount x kParameterCount
};

/// Of a fit that no picture speaks for: only the pose is held a little.
[[nodiscard]] FitForm form_unseen(const Fit& fit);

/// Numbers of a fit in the order in which PictureFit solves for them: pose (radians, pixels, log2), light,
/// the mouth's inside, offsets.
inline constexpr int kFitOffsets = kPoseCount + kLightCount + kInteriorCount;
inline constexpr int kFitNumbers = kFitOffsets + kCoefficientCount;

/// @param own  kFitNumbers x kFitNumbers, symmetric: the form over the fit's own numbers
[[nodiscard]] FitForm form_of(const Fit& fit, const cv::Mat1d& own);

}  // namespace fbs
