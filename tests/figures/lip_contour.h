// The snake of the outer lips alone, with adjustable repulsion, to show the effect of this term.
#pragma once

#include <vector>

#include "encoder/track/snake/feature_snake.h"

namespace fbs {

/// Tracks the outer lips as in the paper: each descent starts where the last one ended. The encoder's tracker
/// also starts from the optical flow; this is left out here, so that only the energies hold the curve.
class LipContour {
 public:
  /// @param first      with the mouth closed; the appearance of the lips is learned from it
  /// @param repulsion  factor on the encoder's own weight: 0 switches the term off
  LipContour(const Geometry& geometry, const Pose& pose, const Picture& first, double repulsion);

  void track(const Picture& picture, const Pose& pose);

  /// Between the middles of the upper and the lower contour, eye distances; negative when they have crossed.
  [[nodiscard]] double height() const;

  /// The curve in the picture, pixels; closed.
  [[nodiscard]] std::vector<glm::dvec2> outline(const Pose& pose) const;

 private:
  [[nodiscard]] WorkFrame frame(const Picture& picture, const Pose& pose) const;

  FeatureSnake snake_;
  double eye_distance_px_;
};

}  // namespace fbs
