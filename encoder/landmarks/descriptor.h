// Describes a face at its landmarks: histograms of gradient orientations around each.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <span>

#include "encoder/landmarks/orientation_maps.h"
#include "encoder/landmarks/shape.h"

namespace fbs {

/// At the landmark and around it.
inline constexpr std::array<glm::vec2, 5> kSpotDirections = {
    glm::vec2(0, 0), {1, 0}, {0, 1}, {-1, 0}, {0, -1}};
inline constexpr int kSpots = static_cast<int>(kSpotDirections.size());
inline constexpr int kDescriptorSize = kLandmarkCount * kSpots * kOrientations;

/// Resolution of a descriptor. The face is first drawn upright into a square of this size.
struct Look {
  int side = 0;      ///< pixels of the square; the face fills about two thirds of it
  float sigma = 0;   ///< by which orientations are smoothed, pixels of the square
  float radius = 0;  ///< of the spots around the landmark, pixels of the square
};

/// A face at one resolution: drawn upright, with the orientation_maps() of that drawing.
class UprightView {
 public:
  /// @param patch  luma
  /// @param shape  landmarks in the patch; within a few patches of it
  /// @param mean   the mean shape, in units of its root-mean-square radius about (0, 0): the patch is turned
  ///               and scaled so that `shape` comes nearest to it
  UprightView(const cv::Mat1b& patch, const Shape& shape, const Shape& mean, const Look& look);

  /// The maps at the spots; each landmark's together are scaled to unit length.
  /// @param shape  in the patch: the constructor's, or one with about the same rotation and size
  /// @param out    kDescriptorSize: landmark by landmark, spot by spot
  void describe(const Shape& shape, std::span<float> out) const;

 private:
  PlaneSimilarity to_square_;
  float radius_;
  cv::Mat maps_;
};

}  // namespace fbs
