// Cost of the surround in a picture: at the similarities found, and near them.
#pragma once

#include <span>

#include "encoder/model/picture_cost.h"
#include "encoder/surround/head_displacement.h"
#include "encoder/surround/keypoint.h"
#include "encoder/surround/similarity.h"

namespace fbs {

/// Motion of the three layers in a picture.
struct LayerMotion {
  HeadDisplacement head;
  Similarity body{}, ground{};

  /// Displacement of a keypoint that follows the layers in these shares: pixels of the picture.
  [[nodiscard]] glm::dvec2 displacement_of(const Keypoint& keypoint, const LayerShares& share) const;
};

/// Second-order change of the squared luma difference, in samples of the full picture, with the numbers of
/// body and ground (State's units): over the squares of the visible keypoints as they moved.
/// @param mapped  keypoints move as the map says; else as their membership does
[[nodiscard]] cv::Mat1d surround_quadratic(std::span<const Keypoint> keypoints, bool mapped);

/// The squared luma difference itself, at those numbers: the sum over the keypoints' squares of rho(now -
/// first) times the samples of the full picture that a square covers, with rho of Geman and McClure (at most
/// kOutlierSigma^2, so that what the head hides or uncovers is bounded) and the square's luma taken at one
/// place in each quarter, moved by the keypoint's shares of the layers' motions. Squares without a keypoint
/// (flat, or covered by the head) and those that leave the picture count nothing.
/// @param now     work picture
/// @param factor  pixels of the picture per work pixel
[[nodiscard]] double surround_constant(std::span<const Keypoint> keypoints, bool mapped, const cv::Mat& now,
                                       int factor, const LayerMotion& motion);

}  // namespace fbs
