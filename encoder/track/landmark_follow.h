// The expression of a tracked head that a picture's landmarks show, independent of earlier pictures.
// Landmarks are searched here, or come from another tracker.
#pragma once

#include <optional>

#include "encoder/landmarks/landmark_search.h"
#include "encoder/model/fit.h"
#include "encoder/track/landmark_expression.h"

namespace fbs {

class LandmarkFollow {
 public:
  /// Takes the search's error on this person's resting face as its error always.
  /// @param search  must outlive the object; null: nothing is searched
  /// @param pose    of the head in `first`
  LandmarkFollow(const LandmarkSearch* search, const Geometry& geometry, const Pose& pose,
                 const cv::Mat& first);

  /// Sets another tracker's landmarks of the next picture.
  void give(const LandmarkPoints& landmarks) { given_ = landmarks; }

  /// The most probable offsets by the landmarks of a picture; pupils at rest. Nothing if the landmarks are
  /// not believed.
  /// @param picture  luma, 8 bits
  /// @param pose     of the head in the picture; if the landmarks of rigid parts are elsewhere, all are moved
  ///                 back
  /// @param before   offsets from which the search starts
  [[nodiscard]] std::optional<Offsets> find(const cv::Mat& picture, const Pose& pose,
                                            const Offsets& before) const;
  /// The same by the given landmarks; nothing as long as their tracker's error is not known.
  [[nodiscard]] std::optional<Offsets> by_given(const Pose& pose) const;

  /// Ends the picture: given landmarks hold for one.
  /// @param seen  the fit, if the face is seen: the first one tells the error of the other tracker
  void end_picture(const Fit* seen);

 private:
  [[nodiscard]] std::optional<LandmarkPoints> search_landmarks(const cv::Mat& picture, const Pose& pose,
                                                               const Offsets& before) const;

  const LandmarkSearch* search_;
  Geometry geometry_;
  LandmarkExpression expression_, expression_by_given_;
  std::optional<LandmarkPoints> given_;
};

}  // namespace fbs
