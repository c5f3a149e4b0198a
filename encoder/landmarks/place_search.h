// Finds where faces may be in a picture.
#pragma once

#include <span>
#include <vector>

#include "encoder/landmarks/face_patch.h"
#include "encoder/landmarks/landmark_table.h"

namespace fbs {

/// Sizes of faces to look for.
struct EyeDistances {
  double least_px = 0, most_px = 0;
};

/// Scores all places and sizes, a third of the eye distance and a fifth of the size apart, by the picture's
/// likeness to the mean face: a linear function of the orientations around its 68 landmarks. A sliding window
/// as in Dalal & Triggs, Histograms of Oriented Gradients, 2005, whose cells lie on the face. The best place
/// is the face in 148 of 151 strangers' stills (five-fold), one of the best two in 150.
class PlaceSearch {
 public:
  static constexpr double kSizeStep = 1.2;  ///< between the sizes searched

  explicit PlaceSearch(const LandmarkTable& table);

  struct Place {
    FacePlace place;
    float score = 0;  ///< about 1 on a face and 0 elsewhere
  };

  /// Best first; no two are the same face.
  /// @param picture  luma, 8 bits
  [[nodiscard]] std::vector<Place> find(const cv::Mat& picture, const EyeDistances& sizes,
                                        std::size_t count) const;

  /// The descriptor that the score is linear in, at the middle of a FacePatch.
  /// @param mean  as in a table
  /// @param out   kDescriptorSize
  static void describe(const cv::Mat1b& patch, const Shape& mean, std::span<float> out);

  /// The score of the middle of a FacePatch.
  [[nodiscard]] static float score(const cv::Mat1b& patch, const LandmarkTable& table);

 private:
  std::vector<cv::Point> spots_;  ///< sampled positions relative to the face's middle: landmark by landmark
  std::vector<Histogram> weights_;
  float offset_;
};

}  // namespace fbs
