// Finds the faces of a picture with their landmarks: several detectors propose places, landmarks are searched
// at each, and what is believed is taken.
#pragma once

#include <cstdint>
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
  /// Belief from which a face is taken for one, at a place that is likely (FaceDetector) and at one that is
  /// only possible: most of those are no faces, and the belief was learned from places of which half are.
  static constexpr double kBelieved = 0.5, kBelievedWherePossible = 0.7;

  enum class Effort : std::uint8_t { kLikelyPlaces, kAllPlaces };

  /// kIo when the detectors' cascades are not found; errors of load_landmarks().
  static Result<FaceFinder> create();

  /// The largest first.
  /// @param wanted  places that are only possible are looked at if fewer are found at likely ones
  /// @param effort  whether they are at all: they take ten times as long
  [[nodiscard]] std::vector<FoundFace> find(const Picture& picture, std::size_t wanted = 1,
                                            Effort effort = Effort::kAllPlaces) const;

  [[nodiscard]] const FaceDetector& detector() const { return detector_; }
  [[nodiscard]] const LandmarkSearch& landmarks() const { return landmarks_; }

 private:
  FaceFinder(FaceDetector detector, LandmarkSearch landmarks)
      : detector_(std::move(detector)), landmarks_(std::move(landmarks)) {}

  FaceDetector detector_;
  LandmarkSearch landmarks_;
};

}  // namespace fbs
