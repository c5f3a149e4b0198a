// The snake of one feature: curve, energies' input, and present position.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "bitstream/syntax.h"
#include "encoder/track/snake/b_snake.h"
#include "encoder/track/snake/feature_map.h"
#include "encoder/track/snake/feature_patch.h"
#include "encoder/track/snake/rest_shape.h"
#include "encoder/track/snake/snake_kinds.h"

namespace fbs {

struct FeatureSnake {
  FeatureId id;
  SnakeCurve curve;
  SnakeWeights weights;
  PatchPlane plane{};  ///< the patch it sees
  FeatureMap map{};
  std::optional<FeatureMap> skin{};       ///< for a lid: likeness to its own skin, which lies above the edge
  std::vector<glm::dvec2> rest{}, now{};  ///< control points including pinned ones, snake units
  std::vector<FacingPair> facing{};
  double below_vertices = 0;  ///< distance of the curve below the vertices it moves
  double lowest = 1e9;        ///< y that a lid's middle does not pass: just above the lower lid
  cv::Mat1f seen{};           ///< feature map of the picture before; empty when I_t has no weight
  int iterations = 0;         ///< in the last descent

  /// A snake at rest on the adapted head. It sees nothing before learn().
  static FeatureSnake make(FeatureId id, const Geometry& geometry);

  /// The part of a picture that the snake looks at, in the head's own frame.
  [[nodiscard]] FeaturePatch patch(const WorkFrame& frame, const Pose& pose) const;

  /// Learns from the first picture what distinguishes the feature from its surroundings.
  void learn(const FeaturePatch& first);

  /// Moves control points back to where the feature can be: a lid past the lower lid would fold the eye.
  void limit(std::vector<glm::dvec2>& control) const;

  /// The energies' maps for a picture. Keeps it for the next picture's I_t.
  ///
  /// Eq. 8 evaluates I_t on the curve. Its sign there depends on the side of the contour and on the person;
  /// the sign of its contrast across the curve does not: H(I_t) is positive where the contour has come and
  /// negative where it was. So E_v uses H(I_t), and as H is linear, rho H(I) + gamma H(I_t) is H of the map
  /// plus its change.
  SnakeImage observe(const FeaturePatch& patch);

  /// Position of a vertex of the feature on the curve, snake units.
  [[nodiscard]] glm::dvec2 at(const FeatureVertex& vertex, const std::vector<glm::dvec2>& control) const {
    return curve_point(basis_at(curve, static_cast<double>(vertex.s)), control);
  }
};

}  // namespace fbs
