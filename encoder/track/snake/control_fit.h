// Least squares for the control points of a snake's curve.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "common/generic_head.h"
#include "encoder/track/snake/snake_curve.h"

namespace fbs {

/// Normal equations; both axes have the same matrix.
class ControlFit {
 public:
  explicit ControlFit(int controls)
      : a_(cv::Mat1d::zeros(controls, controls)), b_(cv::Mat1d::zeros(controls, 2)) {}

  /// Requires a value of the curve, or of a derivative, at a parameter.
  /// @param basis   at a point of the curve or from basis_at()
  /// @param shares  its value, d1 or d2
  void add(const SplineBasis& basis, const std::array<double, 4>& shares, double weight, glm::dvec2 value);
  /// Requires a value of a control point.
  void add(int control, double weight, glm::dvec2 value);

  [[nodiscard]] std::vector<glm::dvec2> solve() const;

 private:
  cv::Mat1d a_, b_;
};

/// Control points whose curve passes nearest to the wanted positions of the feature's vertices (in
/// Feature::vertices' order), with a little rigidity where they leave it open; pinned control points take
/// `ends`.
[[nodiscard]] std::vector<glm::dvec2> fit_control(const Feature& f, const SnakeCurve& curve,
                                                  std::span<const glm::dvec2> target,
                                                  const std::array<glm::dvec2, 2>& ends);

}  // namespace fbs
