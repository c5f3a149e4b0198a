// The expression of a state as weights of named shapes ("blendshapes"), for animation programs.
//
// Together the shapes reach every expression that a stream can code, and the weights give the control points
// of the state exactly. Names are from ARKit's ARFaceAnchor.BlendShapeLocation where a shape means the same
// movement; left and right are the subject's own.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bitstream/syntax.h"
#include "common/generic_head.h"
#include "common/state.h"

namespace fbs {

/// Offsets of all control points, head units, x to the right of the picture and y down.
using ControlOffsets = std::array<glm::dvec2, kControlCount>;

struct ExpressionTarget {
  std::string name;
  bool detail = false;       ///< without a meaning of its own: part of what the named shapes leave over
  ControlOffsets offsets{};  ///< at a weight of one
};

/// The shapes for one adapted head.
///
/// A named movement at a weight of one is as large as people make it: the jaw opens by 0.6 eye distances, an
/// eyelid closes the eye, the pupil turns by 30 degrees. Weights are 0 in the adapted, expressionless face.
/// Weights of shapes with an opposite (mouthSmile and mouthFrown, eyeBlink and eyeWide, eyeLookIn and
/// eyeLookOut ...) are never negative; jawOpen, mouthUpperUp, browInnerUpAsymmetry, eyeSquint and the details
/// may be.
class ExpressionTargets {
 public:
  /// @param head  determines how far an eyelid goes to close the eye
  explicit ExpressionTargets(const Geometry& head);

  /// The named shapes first, then the details.
  [[nodiscard]] std::span<const ExpressionTarget> targets() const { return targets_; }
  /// Number of shapes that have a meaning.
  [[nodiscard]] std::size_t named_count() const { return named_count_; }

  /// @return one for each target; the offsets at these weights sum to the state's to within rounding of
  /// doubles
  [[nodiscard]] std::vector<double> weights(const State& state) const;

 private:
  /// Directions of a part of the face, orthonormal in its metric. The first ones span the named movements,
  /// the others the rest.
  struct Part {
    std::size_t first = 0;                         ///< control point
    std::vector<std::vector<double>> metric;       ///< of its control points, in x and in y
    std::vector<std::vector<double>> orthonormal;  ///< as many as there are numbers
    std::vector<std::vector<double>>
        triangle;  ///< row k: movement k in the first k + 1 orthonormal directions
  };
  /// Amounts of the part's movements, then of its details.
  [[nodiscard]] static std::vector<double> coefficients(const Part& part, const State& state);
  static Part make_part(const WireFrame& head, const ExpressionPart& expression,
                        std::span<const ControlOffsets> movements);

  std::vector<ExpressionTarget> targets_;
  std::size_t named_count_ = 0;
  std::array<Part, kExpressionPartCount> parts_;
};

/// Names of the named shapes, in the order of ExpressionTargets.
[[nodiscard]] const std::vector<std::string>& blendshape_names();

/// Weights of the named shapes alone, for states of one head after another; caches what depends on the head.
class BlendshapeMeasure {
 public:
  /// @return as many as blendshape_names()
  [[nodiscard]] std::vector<double> operator()(const Geometry& head, const State& state);

 private:
  std::optional<Geometry> head_;  ///< head of targets_
  std::optional<ExpressionTargets> targets_;
};

/// Displacement of a vertex by the shape at a weight of one, head units; z is zero.
[[nodiscard]] glm::dvec2 displacement(const ExpressionTarget& target, const WireFrame& head,
                                      std::size_t vertex);

}  // namespace fbs
