// Learns to tell places with a face from others.
#pragma once

#include <random>
#include <vector>

#include "encoder/landmarks/face_patch.h"
#include "encoder/landmarks/place_search.h"
#include "training/face_pictures.h"

namespace fbs {

/// How often each face is used, each time augmented.
struct FaceCount {
  FacePicture face;
  int times;
};

/// @param textures  pictures without a face
/// @param mean      as in the table
[[nodiscard]] PlaceTable train_places(const std::vector<FaceCount>& faces,
                                      const std::vector<cv::Mat1b>& textures, const Shape& mean,
                                      std::mt19937& random);

/// The likeliest places of a picture for a face of any size.
[[nodiscard]] std::vector<FacePlace> likeliest(const PlaceSearch& search, const cv::Mat1b& picture,
                                               std::size_t count);

/// Any place in a face's picture and any size of about the face's.
[[nodiscard]] FacePlace any_place(const FacePicture& face, std::mt19937& random);

}  // namespace fbs
