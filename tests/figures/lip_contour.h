// The outer lips' snake by itself, with its repulsion as strong as one likes: what the term is for.
#pragma once

#include <vector>

#include "encoder/track/snake/feature_snake.h"

namespace fbs {

/// Follows the outer lips from picture to picture as the paper does: a descent starts where the one before
/// has ended. The encoder's own tracker also tries where the optical flow took the lips; that help is left
/// out, so that nothing but the energies holds the curve.
class LipContour {
 public:
  /// @param first      with the mouth closed; what lips look like is learned from it
  /// @param repulsion  factor on the encoder's own weight: 0 is the paper's model before it had the term
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
