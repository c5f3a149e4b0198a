// The spatio-temporal B-snake of the paper: energies of eq. 1-8, control points as unknowns (eq. 9), sign
// descent.
#pragma once

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

/// What the snake sees: a picture patch in the head's own frame, as maps of forces' potentials.
struct SnakeImage {
  cv::Mat1f contrast_x, contrast_y;  ///< gradient of the feature map; H is its part along the curve's normal
  cv::Mat1f ridge;          ///< instead: H itself, for a curve that runs along the middle of a dark band
  cv::Mat1f change;         ///< |I_t|: eq. 8 is signed, but a contour that moves brightens one side and
                            ///< darkens the other, so that the sign says nothing about where it went
  glm::dvec2 origin{0, 0};  ///< snake units of the centre of pixel (0, 0)
  double px_per_unit = 1;
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
  [[nodiscard]] const std::vector<int>& support(int i) const { return support_[static_cast<std::size_t>(i)]; }
  /// Parameter distance between neighbouring points: ds of the sums that stand for the integrals.
  [[nodiscard]] double ds() const { return ds_; }
  [[nodiscard]] bool is_closed() const { return closed_; }

 private:
  SnakeCurve(bool is_closed, int controls, int pinned, std::vector<SplineBasis> points, double ds);
  bool closed_;
  int controls_;
  int pinned_;  ///< at each end
  std::vector<SplineBasis> points_;
  std::vector<std::vector<int>> support_;
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

  /// Sign descent: the sign of dE/dX_i and dE/dY_i of all control points, then all move by delta_q against
  /// it; delta_q = delta_0 sigma^q with delta_0 = 1 snake unit and sigma = 0.75. Stops when the energy
  /// changes by less than a threshold from one iteration to the next, at 15 iterations at the latest. A
  /// descent that still falls steeply when its steps have become small starts again from where it is (the
  /// steps sum to 4 units at most).
  [[nodiscard]] SnakeOutcome minimise(std::vector<glm::dvec2> start) const;

 private:
  [[nodiscard]] double point_energy(int point, const std::vector<glm::dvec2>& control) const;
  [[nodiscard]] double repulsion(const FacingPair& pair, const std::vector<glm::dvec2>& control) const;
  [[nodiscard]] double local_energy(int control_index, const std::vector<glm::dvec2>& control) const;

  const SnakeCurve& curve_;
  const SnakeImage& image_;
  const SnakeWeights& weights_;
  const std::vector<FacingPair>& facing_;
  std::vector<glm::dvec2> rest_slope_;              ///< r_s at each point
  std::vector<glm::dvec2> before_;                  ///< v(s, t - 1) at each point
  std::vector<std::vector<int>> pairs_of_control_;  ///< facing pairs that control point i moves
};

}  // namespace fbs
