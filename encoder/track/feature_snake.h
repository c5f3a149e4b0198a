// One feature's snake: its curve, what it looks for, and where it is.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "bitstream/syntax.h"
#include "encoder/image/work_frame.h"
#include "encoder/model/pose.h"
#include "encoder/track/b_snake.h"
#include "encoder/track/feature_map.h"

namespace fbs {

/// Snake units are 1/32 of the eye distance, so that the paper's delta_0 = 1 and sigma = 0.75 reach an eighth
/// of it.
inline constexpr double kHeadUnitsPerSnakeUnit = kUnitsPerEyeDistance / 32.0;

/// A picture patch of a feature: Y, U and V, 8 bit, of one size; a brow's is Y alone.
using FeaturePatch = std::array<cv::Mat, 3>;

struct FeatureSnake {
  FeatureId id;
  SnakeCurve curve;
  SnakeWeights weights;
  cv::Rect2d region{};  ///< of the patch it looks at, snake units of the head frame
  double depth = 0;     ///< z of the feature's plane, head units
  FeatureMap map{};
  std::optional<FeatureMap> skin{};       ///< of a lid: likeness to its own skin, which lies above the edge
  std::vector<glm::dvec2> rest{}, now{};  ///< control points with pinned ones, snake units
  std::vector<FacingPair> facing{};
  double below_vertices = 0;  ///< the curve runs this far below the vertices it moves
  double lowest = 1e9;        ///< y that a lid's middle does not pass: just above the lower lid
  cv::Mat1f seen{};           ///< feature map of the picture before; empty when I_t has no weight
  int iterations = 0;         ///< of the last descent

  /// A snake at rest on the adapted head. It sees nothing before learn().
  static FeatureSnake make(FeatureId id, const Geometry& geometry);

  /// The part of a picture that the snake looks at, in the head's own frame: the feature lies in a plane of
  /// constant depth, which the pose maps to the picture affinely.
  [[nodiscard]] FeaturePatch patch(const WorkFrame& frame, const Pose& pose) const;

  /// Learns from the first picture what tells the feature from what is round it.
  void learn(const FeaturePatch& first);

  /// Brings control points back to where the feature can be: a lid that has passed the lower lid would fold
  /// the eye.
  void limit(std::vector<glm::dvec2>& control) const;

  /// What the energies need of a picture. Remembers it for the next one's I_t.
  SnakeImage look(const FeaturePatch& patch);
};

/// Control points whose curve passes nearest to where the feature's vertices (in Feature::vertices' order)
/// shall be, with a little rigidity where they leave it open; pinned control points take `ends`.
[[nodiscard]] std::vector<glm::dvec2> fit_control(const Feature& f, const SnakeCurve& curve,
                                                  const std::vector<glm::dvec2>& target,
                                                  const std::array<glm::dvec2, 2>& ends);

/// Basis functions of the curve at a feature's parameter, with indices of SnakeCurve's control points.
[[nodiscard]] SplineBasis basis_at(const SnakeCurve& curve, double s);

}  // namespace fbs
