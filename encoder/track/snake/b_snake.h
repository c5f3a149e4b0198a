// The spatio-temporal B-snake of the paper: energies of eq. 1-8, control points as unknowns (eq. 9).
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <opencv2/core.hpp>
#include <vector>

#include "encoder/track/snake/snake_curve.h"

namespace fbs {

/// Weights of the energies, constant along the curve. The first five belong to E_int, the last two to E_img.
/// Lengths are in snake units (1/32 eye distance), contrast in units of the feature's own contrast.
struct SnakeWeights {
  double tension = 0;   ///< alpha, eq. 3
  double rigidity = 0;  ///< beta, eq. 4
  double temporal = 0;  ///< tau, eq. 5
  /// Weight of |v_s - r_s|^2, with r the curve at rest: not in the paper. Contrast sees only motion across
  /// the curve; this keeps points from sliding along it, which would tear the texture.
  double shape = 0;
  double repulsion = 0;  ///< between facing points; the paper gives no formula, see FacingPair
  double contrast = 0;   ///< rho, eq. 7
  double change = 0;     ///< gamma, eq. 8, as a share of rho; FeatureSnake adds it to the maps
};

/// The snake's input: a picture patch in the head's own frame, as potentials of the forces, all maps of one
/// size and without gaps between their rows.
struct SnakeImage {
  cv::Mat1f contrast_x, contrast_y;  ///< gradient of the feature map; H is its part along the curve's normal
  cv::Mat1f ridge;                   ///< instead: H itself, for a curve along the middle of a dark band
  glm::dvec2 origin{0, 0};           ///< centre of pixel (0, 0), snake units
  double px_per_unit = 1;
};

/// Two points of the curve that repel each other: on upper and lower lip, or the two ends of a brow, whose
/// length the paper assumes constant. No force acts while the gap from one to the other along `direction` is
/// large enough.
struct FacingPair {
  int from, to;          ///< indices into SnakeCurve::points()
  glm::dvec2 direction;  ///< unit vector: down for lips, along the brow for brows
  double min_gap;        ///< snake units
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
  /// dE_tot/dX_i and dE_tot/dY_i; map slopes follow bilinear interpolation, the normal turns with v_s.
  [[nodiscard]] std::vector<glm::dvec2> gradient(const std::vector<glm::dvec2>& control) const;

  /// The energy without the curve's factor ds.
  /// @param gradient  set to dE/dX_i and dE/dY_i without that factor; or null
  [[nodiscard]] double evaluate(const std::vector<glm::dvec2>& control,
                                std::vector<glm::dvec2>* gradient) const;
  [[nodiscard]] const SnakeCurve& curve() const { return curve_; }

 private:
  using Vectors = std::vector<glm::dvec2>;  // one for each control point

  // Each returns its energy without the factor ds and, unless `gradient` is null, adds its dE/dX_i, dE/dY_i.
  double internal(const Vectors& control, Vectors* gradient) const;
  double repulsion(const Vectors& control, Vectors* gradient) const;
  double external(const Vectors& control, Vectors* gradient) const;

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
