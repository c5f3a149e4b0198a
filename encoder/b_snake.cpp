#include "encoder/b_snake.h"

#include <algorithm>
#include <cmath>

namespace fbs {
namespace {

constexpr double kDelta0 = 1.0;  // snake units
constexpr double kSigma = 0.75;
constexpr int kMaxIterations = 15;
constexpr int kMaxRestarts = 2;
constexpr double kStopChange = 2e-4;      // of the energy, from iteration to iteration
constexpr double kNearlyFullReach = 3.0;  // snake units; the steps sum to delta_0 / (1 - sigma) = 4
constexpr double kProbe = 0.25;           // snake units either way, for the sign of the derivative

double bilinear(const cv::Mat1f& m, double u, double v) {
  const double cu = std::clamp(u, 0.0, m.cols - 1.001), cv_ = std::clamp(v, 0.0, m.rows - 1.001);
  const int i = static_cast<int>(cu), j = static_cast<int>(cv_);
  const double fu = cu - i, fv = cv_ - j;
  const float* a = m[j] + i;
  const float* b = m[j + 1] + i;
  return (a[0] * (1 - fu) + a[1] * fu) * (1 - fv) + (b[0] * (1 - fu) + b[1] * fu) * fv;
}

glm::dvec2 combine(const SplineBasis& b, const std::array<double, 4>& weight,
                   const std::vector<glm::dvec2>& control) {
  glm::dvec2 sum(0);
  for (std::size_t k = 0; k < 4; ++k) sum += weight[k] * control[static_cast<std::size_t>(b.control[k])];
  return sum;
}

double squared(glm::dvec2 v) {
  return v.x * v.x + v.y * v.y;
}

}  // namespace

glm::dvec2 curve_point(const SplineBasis& basis, const std::vector<glm::dvec2>& control) {
  return combine(basis, basis.value, control);
}

SnakeCurve::SnakeCurve(bool is_closed, int controls, int pinned, std::vector<SplineBasis> points, double ds)
    : closed_(is_closed),
      controls_(controls),
      pinned_(pinned),
      points_(std::move(points)),
      support_(static_cast<std::size_t>(controls)),
      ds_(ds) {
  for (std::size_t h = 0; h < points_.size(); ++h)
    for (std::size_t k = 0; k < 4; ++k)
      if (std::abs(points_[h].value[k]) > 1e-9)
        support_[static_cast<std::size_t>(points_[h].control[k])].push_back(static_cast<int>(h));
}

SnakeCurve SnakeCurve::closed(int controls, int points) {
  std::vector<SplineBasis> basis;
  const double ds = static_cast<double>(controls) / points;
  for (int h = 0; h < points; ++h) basis.push_back(closed_basis(controls, h * ds));
  return {true, controls, 0, std::move(basis), ds};
}

SnakeCurve SnakeCurve::clamped(int points, bool free_ends) {
  std::vector<SplineBasis> basis;
  const double ds = 1.0 / (points - 1);
  for (int h = 0; h < points; ++h) basis.push_back(clamped_basis(true, h * ds));
  return {false, 4, free_ends ? 0 : 1, std::move(basis), ds};
}

BSnake::BSnake(const SnakeCurve& curve, const SnakeImage& image, const SnakeWeights& weights,
               const std::vector<glm::dvec2>& rest, const std::vector<glm::dvec2>& before,
               const std::vector<FacingPair>& facing)
    : curve_(curve),
      image_(image),
      weights_(weights),
      facing_(facing),
      pairs_of_control_(static_cast<std::size_t>(curve.controls())) {
  for (const SplineBasis& b : curve.points()) {
    rest_slope_.push_back(combine(b, b.d1, rest));
    before_.push_back(curve_point(b, before));
  }
  for (std::size_t p = 0; p < facing.size(); ++p) {
    for (const int h : {facing[p].from, facing[p].to}) {
      for (const int c : curve.points()[static_cast<std::size_t>(h)].control) {
        auto& list = pairs_of_control_[static_cast<std::size_t>(c)];
        if (list.empty() || list.back() != static_cast<int>(p)) list.push_back(static_cast<int>(p));
      }
    }
  }
}

double BSnake::point_energy(int point, const std::vector<glm::dvec2>& control) const {
  const SplineBasis& b = curve_.points()[static_cast<std::size_t>(point)];
  const glm::dvec2 v = combine(b, b.value, control);
  const glm::dvec2 vs = combine(b, b.d1, control), vss = combine(b, b.d2, control);
  const glm::dvec2 vt = v - before_[static_cast<std::size_t>(point)];
  const double internal = weights_.tension * squared(vs)      // eq. 3
                          + weights_.rigidity * squared(vss)  // eq. 4
                          + weights_.temporal * squared(vt)   // eq. 5
                          + weights_.shape * squared(vs - rest_slope_[static_cast<std::size_t>(point)]);
  const glm::dvec2 at = (v - image_.origin) * image_.px_per_unit;
  double h = 0;
  if (image_.ridge.empty()) {
    // The curve runs clockwise in the picture, so (vs.y, -vs.x) points outwards. The feature map is high
    // inside: the contrast that shows the contour is its fall along the normal.
    const double length = std::sqrt(squared(vs)) + 1e-9;
    h = (bilinear(image_.contrast_y, at.x, at.y) * vs.x - bilinear(image_.contrast_x, at.x, at.y) * vs.y) /
        length;
  } else {
    h = bilinear(image_.ridge, at.x, at.y);
  }
  double external = weights_.contrast * h;                                                      // eq. 7
  if (weights_.change != 0) external += weights_.change * bilinear(image_.change, at.x, at.y);  // eq. 8
  return internal - external;
}

double BSnake::repulsion(const FacingPair& pair, const std::vector<glm::dvec2>& control) const {
  // Quadratic in what the gap falls short of the least one. The gap is signed, so that points that have
  // crossed are driven apart again and not farther through each other.
  const glm::dvec2 gap = curve_point(curve_.points()[static_cast<std::size_t>(pair.to)], control) -
                         curve_point(curve_.points()[static_cast<std::size_t>(pair.from)], control);
  const double lacks = std::max(0.0, pair.least_gap - (gap.x * pair.direction.x + gap.y * pair.direction.y));
  return weights_.repulsion * lacks * lacks;
}

double BSnake::energy(const std::vector<glm::dvec2>& control) const {
  double sum = 0;
  for (int h = 0; h < static_cast<int>(curve_.points().size()); ++h) sum += point_energy(h, control);
  for (const FacingPair& p : facing_) sum += repulsion(p, control);
  return sum * curve_.ds();
}

double BSnake::local_energy(int control_index, const std::vector<glm::dvec2>& control) const {
  double sum = 0;
  for (const int h : curve_.support(control_index)) sum += point_energy(h, control);
  for (const int p : pairs_of_control_[static_cast<std::size_t>(control_index)])
    sum += repulsion(facing_[static_cast<std::size_t>(p)], control);
  return sum;
}

SnakeOutcome BSnake::minimise(std::vector<glm::dvec2> start) const {
  SnakeOutcome out{std::move(start), 0, 0, 0};
  out.energy = energy(out.control);
  SnakeOutcome best = out;
  std::vector<glm::dvec2> sign(out.control.size());
  for (int restart = 0; restart <= kMaxRestarts; ++restart) {
    double delta = kDelta0;
    const std::vector<glm::dvec2> descent_start = out.control;
    for (int q = 0; q < kMaxIterations; ++q, delta *= kSigma) {
      for (int i = curve_.first_free(); i < curve_.end_free(); ++i) {
        glm::dvec2& c = out.control[static_cast<std::size_t>(i)];
        for (int axis = 0; axis < 2; ++axis) {
          const double here = c[axis];
          c[axis] = here + kProbe;
          const double above = local_energy(i, out.control);
          c[axis] = here - kProbe;
          const double below = local_energy(i, out.control);
          c[axis] = here;
          sign[static_cast<std::size_t>(i)][axis] = above > below ? 1 : above < below ? -1 : 0;
        }
      }
      for (std::size_t i = 0; i < sign.size(); ++i) out.control[i] -= delta * sign[i];
      const double now = energy(out.control);
      const double change = now - out.energy;
      out.energy = now;
      ++out.iterations;
      if (now < best.energy) {
        best.control = out.control;
        best.energy = now;
      }
      if (std::abs(change) < kStopChange) break;
    }
    best.iterations = out.iterations;
    best.restarts = restart;
    // A control point that has gone nearly as far as the steps reach together was still on its way.
    double farthest = 0;
    for (std::size_t i = 0; i < best.control.size(); ++i)
      farthest = std::max(farthest, squared(best.control[i] - descent_start[i]));
    if (farthest < kNearlyFullReach * kNearlyFullReach) break;
    out.control = best.control;
    out.energy = best.energy;
  }
  return best;
}

}  // namespace fbs
