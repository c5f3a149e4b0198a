// Finds where in a picture faces may be.
#pragma once

#include <span>
#include <vector>

#include "encoder/landmarks/face_patch.h"
#include "encoder/landmarks/landmark_table.h"

namespace fbs {

/// Sizes of faces that are looked for.
struct EyeDistances {
  double least_px = 0, most_px = 0;
};

/// Asks at all places and sizes, a third of the eye distance and a fifth of the size apart, how much the
/// picture looks like the mean face there: a linear function of the orientations round its 68 landmarks. A
/// sliding window as of Dalal & Triggs, Histograms of Oriented Gradients, 2005, whose cells lie on the face.
/// The best place is the face in 148 of 151 strangers' stills (five-fold), one of the best two in 150.
class PlaceSearch {
 public:
  static constexpr double kSizeStep = 1.2;  ///< between sizes that are looked for

  explicit PlaceSearch(const LandmarkTable& table);

  struct Place {
    FacePlace place;
    float score = 0;  ///< about 1 on a face and 0 elsewhere
  };

  /// Best first; no two of them are one face.
  /// @param picture  luma, 8 bits
  [[nodiscard]] std::vector<Place> find(const cv::Mat& picture, const EyeDistances& sizes,
                                        std::size_t count) const;

  /// What the score is a linear function of, at the middle of a FacePatch.
  /// @param mean  as in a table
  /// @param out   kDescriptorSize
  static void describe(const cv::Mat1b& patch, const Shape& mean, std::span<float> out);

  /// Of the middle of a FacePatch.
  [[nodiscard]] static float score(const cv::Mat1b& patch, const LandmarkTable& table);

 private:
  std::vector<cv::Point> spots_;  ///< where the face is looked at, from its middle: landmark by landmark
  std::vector<Histogram> weights_;
  float offset_;
};

}  // namespace fbs
