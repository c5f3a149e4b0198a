// The expression that a picture's landmarks show, whichever program found them.
#pragma once

#include <optional>

#include "encoder/landmarks/landmark_file.h"
#include "encoder/model/pose.h"
#include "encoder/model/skinning.h"

namespace fbs {

/// For one head and one source of landmarks.
class LandmarkExpression {
 public:
  explicit LandmarkExpression(const Geometry& geometry)
      : geometry_(geometry), rest_(skinned(geometry, Offsets{})) {}

  /// Takes the source's error in a picture with a known state as its error in all others.
  void calibrate(const LandmarkPoints& seen, const Pose& pose, const Offsets& offsets);
  [[nodiscard]] bool is_calibrated() const { return calibrated_; }

  /// The most probable offsets; pupils at rest.
  /// @param pose  of the head; if the landmarks of rigid parts are elsewhere, all are moved back
  [[nodiscard]] Offsets offsets(const LandmarkPoints& seen, const Pose& pose) const;

 private:
  using HeadLandmarks = std::array<glm::dvec2, kLandmarkCount>;  ///< x and y in the head frame, eye distances

  /// Positions of the landmarks less the head's own at rest.
  [[nodiscard]] HeadLandmarks displacements(const LandmarkPoints& seen, const Pose& pose) const;

  Geometry geometry_;
  HeadVertices rest_;
  HeadLandmarks bias_{};
  bool calibrated_ = false;
};

}  // namespace fbs
