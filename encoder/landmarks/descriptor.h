// What a face's landmarks look like: histograms of gradient orientations round each of them.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <span>

#include "encoder/landmarks/orientation_maps.h"
#include "encoder/landmarks/shape.h"

namespace fbs {

/// At the landmark and round it.
inline constexpr std::array<glm::vec2, 5> kSpotDirections = {
    glm::vec2(0, 0), {1, 0}, {0, 1}, {-1, 0}, {0, -1}};
inline constexpr int kSpots = static_cast<int>(kSpotDirections.size());
inline constexpr int kDescriptorSize = kLandmarkCount * kSpots * kOrientations;

/// How closely a face is looked at. It is drawn upright into a square as large as this first.
struct Look {
  int side = 0;      ///< pixels of the square; the face fills about two thirds of it
  float sigma = 0;   ///< by which orientations are spread, pixels of the square
  float radius = 0;  ///< of the spots round the landmark, pixels of the square
};

/// A face as a look sees it: drawn upright, and the orientation_maps() of that.
class UprightView {
 public:
  /// @param patch  luma
  /// @param shape  in it; within a few patches of it
  /// @param mean   the mean shape, in units of its root-mean-square radius about (0, 0): the patch is turned
  ///               and scaled so that `shape` comes nearest to it
  UprightView(const cv::Mat1b& patch, const Shape& shape, const Shape& mean, const Look& look);

  /// The maps at the spots; those of a landmark scaled to unit length together.
  /// @param shape  in the patch: the same, or one that lies there alike
  /// @param out    kDescriptorSize: landmark by landmark, spot by spot
  void describe(const Shape& shape, std::span<float> out) const;

 private:
  PlaneSimilarity to_square_;
  float radius_;
  cv::Mat maps_;
};

}  // namespace fbs
