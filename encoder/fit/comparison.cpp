#include "encoder/fit/comparison.h"

#include <algorithm>
#include <cmath>

#include "encoder/fit/patch_equations.h"
#include "encoder/model/pose_jacobian.h"

namespace fbs {
namespace {

/// The share with which a residual counts: most are small, and need no quotient.
double huber_weight(double r) {
  const double size = std::abs(r) + 1e-9;
  return size <= kHuberLevels ? 1 : kHuberLevels / size;
}

/// One fit against one level of the picture.
class LevelEquations {
 public:
  LevelEquations(const Comparison& comparison, int level, const Fit& fit)
      : c_(comparison),
        level_(level),
        to_level_(c_.picture.scale(level)),
        jacobian_(fit.pose),
        head_(comparison.geometry, fit),
        shown_(comparison.appearance(fit, head_.vertices)),
        ex_(jacobian_.projection().matrix[0]),
        ey_(jacobian_.projection().matrix[1]) {}

  [[nodiscard]] double samples_per_point(std::size_t patch) const {
    return c_.points.samples_per_point(patch, head_);
  }

  /// The row of a point and its residual.
  /// @param shares  of the patch's control points  @return the robust squared residual
  double add_point(std::size_t k, std::span<const float> shares, PatchEquations& out) const {
    const double value = shown_.at(k, level_);
    if (value < 0) return 0;
    const glm::dvec3 p = c_.points[k].on(head_.vertices);
    Sample s;
    if (!c_.picture.sample(level_, jacobian_.projection()(p), s)) return 0;
    const double r = value - static_cast<double>(s.value);
    const double weight = huber_weight(r) / (kResidualSigma * kResidualSigma);
    float* row = out.row();
    for (const glm::dvec2& by : jacobian_.at(p))
      *row++ = static_cast<float>(to_level_ * (s.dx * by.x + s.dy * by.y));
    row = add_shading(k, row);
    const auto by_x = static_cast<float>(to_level_ * (s.dx * ex_.x + s.dy * ex_.y));
    const auto by_y = static_cast<float>(to_level_ * (s.dx * ey_.x + s.dy * ey_.y));
    for (const float share : shares) {
      *row++ = share * by_x;
      *row++ = share * by_y;
    }
    out.add(static_cast<float>(weight), static_cast<float>(r));
    return huber(r);
  }

 private:
  /// Adds the columns of the light and, inside the mouth, of its interior.
  float* add_shading(std::size_t k, float* row) const {
    const double ramp = c_.points.mouth_ramp(k), interior = shown_.interior_share(k);
    const auto luma = static_cast<double>(c_.pattern.luma(level_, k));
    for (const double light : light_basis(c_.points.light(k), luma))
      *row++ = static_cast<float>(-light * (1 - interior));
    if (ramp < 0) return row;
    for (const double level : interior_basis(ramp)) *row++ = static_cast<float>(-level * interior);
    return row;
  }

  const Comparison& c_;
  int level_;
  double to_level_;  ///< samples of the level per pixel
  PoseJacobian jacobian_;
  PlacedHead head_;
  Appearance shown_;
  glm::dvec2 ex_, ey_;  ///< axes of the head frame in the picture, pixels per head unit
};

}  // namespace

Comparison Comparison::with(const Setup& setup, const Geometry& geometry, const SeenPattern& pattern) {
  const FitColumns columns(setup.parts);
  const SamplePoints points(geometry, columns, PlacedHead(geometry, fit_of(pattern.seen)),
                            kFitPointSpacing / pattern.frame.scale);
  return {geometry, columns, points, PatternSamples(points, geometry, pattern), {}, setup.mouth};
}

double huber(double difference) {
  const double r = std::abs(difference);
  return r < kHuberLevels ? r * r : kHuberLevels * (2 * r - kHuberLevels);
}

double mean_difference(const Comparison& c, const Fit& fit) {
  const PlacedHead head(c.geometry, fit);
  const Appearance shown = c.appearance(fit, head.vertices);
  double sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < c.points.size(); ++k) {
    const double value = shown.at(k, 0);
    Sample s;
    if (value < 0 || !c.picture.sample(0, head(c.points[k]), s)) continue;
    sum += huber(value - static_cast<double>(s.value));
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

double add_picture(const Comparison& c, int level, const Fit& fit, NormalEquations& normal) {
  const LevelEquations equations(c, level, fit);
  PatchEquations patch_equations;
  double difference = 0;
  for (std::size_t i = 0; i < c.points.patches().size(); ++i) {
    const SamplePoints::Patch& patch = c.points.patches()[i];
    const std::size_t n = patch.controls.size();
    patch_equations.begin(patch.columns.size(), patch.size());
    double of_patch = 0;
    for (std::size_t k = patch.first; k < patch.end; ++k)
      of_patch +=
          equations.add_point(k, std::span(patch.shares).subspan((k - patch.first) * n, n), patch_equations);
    patch_equations.add_to(patch.columns, normal);
    difference += equations.samples_per_point(i) * of_patch;
  }
  return difference;
}

}  // namespace fbs
