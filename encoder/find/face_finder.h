// Finds the faces of a picture with their landmarks: several detectors propose places, landmarks are searched
// at each, and what is believed is taken.
#pragma once

#include <utility>
#include <vector>

#include "common/picture.h"
#include "common/result.h"
#include "encoder/find/face_detector.h"
#include "encoder/landmarks/landmark_search.h"

namespace fbs {

/// A face that is believed.
struct FoundFace {
  FoundLandmarks landmarks;
  FacePlace place;  ///< by the landmarks
};

class FaceFinder {
 public:
  /// Belief from which a face is taken for one.
  static constexpr double kBelieved = 0.5;

  /// kIo when the detectors' cascades are not found; errors of load_landmarks().
  static Result<FaceFinder> create();

  /// The largest first.
  /// @param wanted  the search ends when as many are found
  [[nodiscard]] std::vector<FoundFace> find(const Picture& picture, std::size_t wanted = 1) const;

  [[nodiscard]] const FaceDetector& detector() const { return detector_; }
  [[nodiscard]] const LandmarkSearch& landmarks() const { return landmarks_; }

 private:
  FaceFinder(FaceDetector detector, LandmarkSearch landmarks)
      : detector_(std::move(detector)), landmarks_(std::move(landmarks)) {}

  FaceDetector detector_;
  LandmarkSearch landmarks_;
};

}  // namespace fbs
