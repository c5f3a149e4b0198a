// The fixed part of a snake's B-spline curve: basis functions at the points over which energies are summed.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <vector>

#include "common/bspline.h"

namespace fbs {

/// Four neighbouring points that the same control points move; fewer are filled up with copies of the last
/// with weight zero. One step of the loops over the curve.
struct PointQuad {
  std::array<int, 4> control;
  alignas(16) float value[4][4], d1[4][4];  ///< B_i and dB_i/ds, [control][point]
  alignas(16) float weight[4];              ///< 1 or 0
};

/// The curve's fixed part: basis functions at the p + 1 points over which the energies are summed.
class SnakeCurve {
 public:
  /// Closed curve with `controls` control points, sampled at `points` even steps of s.
  static SnakeCurve closed(int controls, int points);
  /// Clamped cubic with four control points.
  /// @param free_ends  false: the first and the last control point are pinned
  static SnakeCurve clamped(int points, bool free_ends = true);

  [[nodiscard]] int controls() const { return controls_; }
  /// The control points that may move: [first_free, end_free).
  [[nodiscard]] int first_free() const { return pinned_; }
  [[nodiscard]] int end_free() const { return controls_ - pinned_; }
  [[nodiscard]] const std::vector<SplineBasis>& points() const { return points_; }
  /// Parameter distance of neighbouring points: ds of the sums that approximate the integrals.
  [[nodiscard]] double ds() const { return ds_; }
  [[nodiscard]] bool is_closed() const { return closed_; }
  /// The points once more, four at a time.
  [[nodiscard]] const std::vector<PointQuad>& quads() const { return quads_; }
  /// Gram matrix of the basis functions' n-th derivatives, row by row: sum over the points of B_i(s) B_j(s).
  /// So sum |v|^2 = c' G c for either coordinate, and internal energies need no loop over the points.
  /// @param derivative  0, 1 or 2
  [[nodiscard]] const std::vector<double>& gram(int derivative) const { return gram_[derivative]; }

 private:
  SnakeCurve(bool is_closed, int controls, int pinned, std::vector<SplineBasis> points, double ds);
  bool closed_;
  int controls_;
  int pinned_;  ///< at each end
  std::vector<SplineBasis> points_;
  std::vector<PointQuad> quads_;
  std::array<std::vector<double>, 3> gram_;
  double ds_;
};

/// v(s) for control points.
[[nodiscard]] glm::dvec2 curve_point(const SplineBasis& basis, const std::vector<glm::dvec2>& control);

/// Basis functions of the curve at a feature's parameter, with indices of its control points.
[[nodiscard]] SplineBasis basis_at(const SnakeCurve& curve, double s);

}  // namespace fbs
