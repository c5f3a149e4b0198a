// More faces from existing ones: each is mirrored, turned, stretched, lit, blurred and partly covered.
#pragma once

#include <opencv2/core.hpp>
#include <random>

#include "encoder/landmarks/face_patch.h"
#include "training/face_pictures.h"

namespace fbs {

/// A patch as the search would see it, and the landmarks in it.
struct PatchSample {
  cv::Mat1b patch;  ///< kPatchSide x kPatchSide
  Shape truth;
};

/// Error of the supposed place of a face.
struct PlaceNoise {
  float shift = 0.12F;  ///< deviation, eye distances
  float scale = 0.12F;  ///< log
};

/// The face unchanged, about its supposed place.
[[nodiscard]] PatchSample as_it_is(const FacePicture& face, const PlaceNoise& noise, std::mt19937& random);

/// @param place  supposed place of the face, without the noise: the patch is centred on it
[[nodiscard]] PatchSample augmented(const FacePicture& face, const FacePlace& place, const PlaceNoise& noise,
                                    std::mt19937& random);

}  // namespace fbs
