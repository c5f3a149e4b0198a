// The spatio-temporal B-snake of the paper: energies of eq. 1-8, control points as unknowns (eq. 9), sign
// descent.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "common/bspline.h"

namespace fbs {

/// Weights of the energies, constant along the curve. The first five belong to E_int, the last two to E_img.
/// Lengths are in snake units (1/32 eye distance), contrast in units of the feature's own contrast.
struct SnakeWeights {
  double tension = 0;   ///< alpha, eq. 3
  double rigidity = 0;  ///< beta, eq. 4
  double temporal = 0;  ///< tau, eq. 5
  double shape =
      0;  ///< of |v_s - r_s|^2, with r the curve at rest: not in the paper. Contrast sees motion across
          ///< the curve only; this keeps points from sliding along it, which would tear the texture
  double repulsion = 0;  ///< between facing points; the paper gives no formula, see FacingPair
  double contrast = 0;   ///< rho, eq. 7
  double change = 0;     ///< gamma, eq. 8
};

/// What the snake sees: a picture patch in the head's own frame, as maps of forces' potentials, all of one
/// size and without gaps between their rows.
struct SnakeImage {
  cv::Mat1f contrast_x, contrast_y;  ///< gradient of the feature map; H is its part along the curve's normal
  cv::Mat1f ridge;          ///< instead: H itself, for a curve that runs along the middle of a dark band
  cv::Mat1f change;         ///< |I_t|: eq. 8 is signed, but a contour that moves brightens one side and
                            ///< darkens the other, so that the sign says nothing about where it went;
                            ///< may be empty when its weight is zero
  glm::dvec2 origin{0, 0};  ///< snake units of the centre of pixel (0, 0)
  double px_per_unit = 1;
};

/// Four neighbouring points that the same control points move, or fewer and copies of the last without a say:
/// one step of the loops over the curve.
struct PointQuad {
  std::array<int, 4> control;
  alignas(16) float value[4][4], d1[4][4];  ///< B_i and dB_i/ds, [control][point]
  alignas(16) float say[4];                 ///< 1 or 0
};

/// The curve's fixed part: basis functions at the p + 1 points over which the energies are summed.
class SnakeCurve {
 public:
  /// Closed curve with `controls` control points, sampled at `points` even steps of s.
  static SnakeCurve closed(int controls, int points);
  /// Clamped cubic with four control points.
  /// @param free_ends  false: the first and the last control point are pinned where they are
  static SnakeCurve clamped(int points, bool free_ends = true);

  [[nodiscard]] int controls() const { return controls_; }
  /// The control points that may move: [first_free, end_free).
  [[nodiscard]] int first_free() const { return pinned_; }
  [[nodiscard]] int end_free() const { return controls_ - pinned_; }
  [[nodiscard]] const std::vector<SplineBasis>& points() const { return points_; }
  /// Indices of the points that control point i moves.
  [[nodiscard]] const std::vector<int>& support(int i) const { return support_[i]; }
  /// Parameter distance between neighbouring points: ds of the sums that stand for the integrals.
  [[nodiscard]] double ds() const { return ds_; }
  [[nodiscard]] bool is_closed() const { return closed_; }
  /// The points once more, as the external energies' loops want them.
  [[nodiscard]] const std::vector<PointQuad>& quads() const { return quads_; }
  /// Gram matrix of the basis functions' n-th derivatives, row after row: sum over the points of
  /// B_i(s) B_j(s). So sum |v|^2 = c' G c of either coordinate, and internal energies need no points.
  /// @param derivative  0, 1 or 2
  [[nodiscard]] const std::vector<double>& gram(int derivative) const { return gram_[derivative]; }

 private:
  SnakeCurve(bool is_closed, int controls, int pinned, std::vector<SplineBasis> points, double ds);
  bool closed_;
  int controls_;
  int pinned_;  ///< at each end
  std::vector<SplineBasis> points_;
  std::vector<std::vector<int>> support_;
  std::vector<PointQuad> quads_;
  std::array<std::vector<double>, 3> gram_;
  double ds_;
};

/// v(s) of control points.
[[nodiscard]] glm::dvec2 curve_point(const SplineBasis& basis, const std::vector<glm::dvec2>& control);

/// Two points of the curve that repel each other: upper and lower lip, or the two ends of a brow, whose
/// length the paper takes as constant. No force acts while the gap from one to the other along `direction` is
/// large enough.
struct FacingPair {
  int from, to;          ///< indices into SnakeCurve::points()
  glm::dvec2 direction;  ///< unit vector: down for lips, along the brow for brows
  double least_gap;      ///< snake units
};

struct SnakeOutcome {
  std::vector<glm::dvec2> control;
  int iterations = 0;
  int restarts = 0;
  double energy = 0;
};

/// One snake on one picture.
class BSnake {
 public:
  /// @param rest    control points at rest (for SnakeWeights::shape)
  /// @param before  control points in the picture before (for SnakeWeights::temporal)
  /// Curve, image, weights and facing must outlive the object.
  BSnake(const SnakeCurve& curve, const SnakeImage& image, const SnakeWeights& weights,
         const std::vector<glm::dvec2>& rest, const std::vector<glm::dvec2>& before,
         const std::vector<FacingPair>& facing);

  /// E_tot = E_int - E_img (eq. 1) of the whole curve.
  [[nodiscard]] double energy(const std::vector<glm::dvec2>& control) const;
  /// dE_tot/dX_i and dE_tot/dY_i; maps slope as their bilinear interpolation does, the normal turns with v_s.
  [[nodiscard]] std::vector<glm::dvec2> gradient(const std::vector<glm::dvec2>& control) const;

  /// Sign descent: the sign of dE/dX_i and dE/dY_i of all control points, then all move by delta_q against
  /// it; delta_q = delta_0 sigma^q with delta_0 = 1 snake unit and sigma = 0.75. Stops when the energy
  /// changes by less than a threshold from one iteration to the next, at 15 iterations at the latest. A
  /// descent that still falls steeply when its steps have become small starts again from where it is (the
  /// steps sum to 4 units at most).
  [[nodiscard]] SnakeOutcome minimise(std::vector<glm::dvec2> start) const;

 private:
  using Vectors = std::vector<glm::dvec2>;  // one for each control point

  // Each gives its energy but for the factor ds and, unless `gradient` is null, adds its dE/dX_i, dE/dY_i.
  double internal(const Vectors& control, Vectors* gradient) const;
  double repulsion(const Vectors& control, Vectors* gradient) const;
  double external(const Vectors& control, Vectors* gradient) const;
  double evaluate(const Vectors& control, Vectors* gradient) const;

  const SnakeCurve& curve_;
  const SnakeImage& image_;
  const SnakeWeights& weights_;
  const std::vector<FacingPair>& facing_;
  // Eq. 2-5 are quadratic in the control points c, one axis like the other: c' Q c - 2 q' c + k.
  std::vector<double> quadratic_;  ///< Q, row after row
  Vectors linear_;                 ///< q
  double constant_ = 0;            ///< k
};

}  // namespace fbs
