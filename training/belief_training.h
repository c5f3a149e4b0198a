// Learns how far the landmarks at the end of a search can be believed.
#pragma once

#include <random>
#include <vector>

#include "encoder/landmarks/landmark_search.h"
#include "training/face_pictures.h"
#include "training/ridge.h"

namespace fbs {

/// Results of the search at places of a picture, by a cascade that has not seen the person.
struct Outcomes {
  RowMatrix descriptors;       ///< one row each: the views of a BeliefTable at the end
  std::vector<float> spreads;  ///< Agreement::spread
  std::vector<float> places;   ///< PlaceSearch::score
  std::vector<float> error;    ///< of lips or eyes, whichever is worse, eye distances; large without a face
};

/// A landmark search with a larger error, eye distances, has failed.
inline constexpr float kWrongFrom = 0.2F;

/// Searches at places near each face, farther off, elsewhere in the picture, and where a face is most likely
/// by the places of the table.
/// @param textures  pictures without a face
[[nodiscard]] Outcomes try_search(const LandmarkSearch& search, const std::vector<FacePicture>& faces,
                                  const std::vector<cv::Mat1b>& textures, std::mt19937& random);

[[nodiscard]] BeliefTable train_belief(const std::vector<const Outcomes*>& outcomes);

/// Mean error of some landmarks, eye distances of `truth`.
[[nodiscard]] float error_of(const Shape& found, const Shape& truth, int first, int end);

}  // namespace fbs
