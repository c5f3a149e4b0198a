// The expression of a tracked head, found anew in a picture: by landmarks, independent of earlier pictures.
#pragma once

#include <optional>

#include "encoder/landmarks/landmark_search.h"
#include "encoder/track/landmark_expression.h"

namespace fbs {

class LandmarkFollow {
 public:
  /// Takes the search's error on this person's resting face as its error always.
  /// @param search  must outlive the object
  /// @param pose    of the head in `first`
  LandmarkFollow(const LandmarkSearch& search, const Geometry& geometry, const Pose& pose,
                 const cv::Mat& first);

  /// The most probable offsets by the landmarks of a picture; pupils at rest. Nothing if the landmarks are
  /// not believed.
  /// @param picture  luma, 8 bits
  /// @param pose     of the head in the picture; if the landmarks of rigid parts are elsewhere, all are moved
  ///                 back
  /// @param before   offsets from which the search starts
  [[nodiscard]] std::optional<Offsets> find(const cv::Mat& picture, const Pose& pose,
                                            const Offsets& before) const;

 private:
  [[nodiscard]] std::optional<LandmarkPoints> search_landmarks(const cv::Mat& picture, const Pose& pose,
                                                               const Offsets& before) const;

  const LandmarkSearch* search_;
  Geometry geometry_;
  LandmarkExpression expression_;
};

}  // namespace fbs
