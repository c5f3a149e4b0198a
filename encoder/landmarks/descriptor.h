// What a face's landmarks look like: histograms of gradient orientations round each of them.
#pragma once

#include <opencv2/core.hpp>
#include <span>

#include "encoder/landmarks/shape.h"

namespace fbs {

inline constexpr int kOrientations = 8;
inline constexpr int kSpots = 5;  ///< at the landmark and round it: right, below, left, above
inline constexpr int kDescriptorSize = kLandmarkCount * kSpots * kOrientations;

/// How closely a face is looked at. It is drawn upright into a square as large as this first.
struct Look {
  int side = 0;      ///< pixels of the square; the face fills about two thirds of it
  float sigma = 0;   ///< by which orientations are spread, pixels of the square
  float radius = 0;  ///< of the spots round the landmark, pixels of the square
};

/// Gradients of the picture, sorted by their orientation into eight maps that are smoothed, as they are at
/// the spots; those of a landmark scaled to unit length together. Method: Tola, Lepetit, Fua, DAISY, 2010.
/// @param patch  luma
/// @param shape  in it; within a few patches of it
/// @param mean   the mean shape, in units of its root-mean-square radius about (0, 0): shape is turned and
///               scaled to it
/// @param out    kDescriptorSize: landmark by landmark, spot by spot
void describe(const cv::Mat1b& patch, const Shape& shape, const Shape& mean, const Look& look,
              std::span<float> out);

}  // namespace fbs
