// More faces from those there are: each is mirrored, turned, stretched, lit, blurred and partly covered.
#pragma once

#include <opencv2/core.hpp>
#include <random>

#include "encoder/landmarks/face_patch.h"
#include "training/face_pictures.h"

namespace fbs {

/// A patch as the search would see it, and where the landmarks are in it.
struct PatchSample {
  cv::Mat1b patch;  ///< kPatchSide x kPatchSide
  Shape truth;
};

/// How far off the place is at which the face is thought to be.
struct PlaceNoise {
  float shift = 0.12F;  ///< deviation, eye distances
  float scale = 0.12F;  ///< log
};

/// As it is, about where it is thought to be.
[[nodiscard]] PatchSample as_it_is(const FacePicture& face, const PlaceNoise& noise, std::mt19937& random);

/// @param place  where the face is thought to be, but for the noise: the patch is about it
[[nodiscard]] PatchSample augmented(const FacePicture& face, const FacePlace& place, const PlaceNoise& noise,
                                    std::mt19937& random);

}  // namespace fbs
