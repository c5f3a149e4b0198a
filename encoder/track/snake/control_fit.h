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

  /// The curve, or a derivative of it, shall have a value at a parameter.
  /// @param basis   of one of the points of the curve or of basis_at()
  /// @param shares  SplineBasis::value, d1 or d2 of it
  void add(const SplineBasis& basis, const std::array<double, 4>& shares, double weight, glm::dvec2 value);
  /// A control point shall have a value.
  void add(int control, double weight, glm::dvec2 value);

  [[nodiscard]] std::vector<glm::dvec2> solve() const;

 private:
  cv::Mat1d a_, b_;
};

/// Control points whose curve passes nearest to where the feature's vertices (in Feature::vertices' order)
/// shall be, with a little rigidity where they leave it open; pinned control points take `ends`.
[[nodiscard]] std::vector<glm::dvec2> fit_control(const Feature& f, const SnakeCurve& curve,
                                                  std::span<const glm::dvec2> target,
                                                  const std::array<glm::dvec2, 2>& ends);

}  // namespace fbs
