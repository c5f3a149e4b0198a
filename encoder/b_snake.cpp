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
constexpr double kFlat = 1e-7;  // energy per snake unit; a slope below this is rounding and no direction

using Lanes = float[4];

/// A map's bilinear value at four points and its slopes, per sample of the map.
struct MapLookup {
  alignas(16) Lanes value, by_x, by_y;
};

/// Where four points lie in maps of one size.
struct MapPlace {
  std::array<std::ptrdiff_t, 4> offset;  ///< of the sample above and to the left
  alignas(16) Lanes fx, fy;
  alignas(16) Lanes inside_x, inside_y;  ///< 1, or 0 where the map's border is repeated and nothing slopes
};

MapPlace place(const cv::Mat1f& map, const Lanes& x, const Lanes& y) {
  MapPlace p;
  const float most_x = static_cast<float>(map.cols) - 1.001F, most_y = static_cast<float>(map.rows) - 1.001F;
  const auto stride = static_cast<std::ptrdiff_t>(map.step1());
  for (std::size_t l = 0; l < 4; ++l) {
    const float cx = std::min(std::max(x[l], 0.0F), most_x), cy = std::min(std::max(y[l], 0.0F), most_y);
    const int i = static_cast<int>(cx), j = static_cast<int>(cy);
    p.fx[l] = cx - static_cast<float>(i);
    p.fy[l] = cy - static_cast<float>(j);
    p.inside_x[l] = cx == x[l] ? 1.0F : 0.0F;
    p.inside_y[l] = cy == y[l] ? 1.0F : 0.0F;
    p.offset[l] = j * stride + i;
  }
  return p;
}

MapLookup look_up(const cv::Mat1f& map, const MapPlace& p) {
  alignas(16) Lanes a, b, c, d;
  const float* first = map[0];
  const auto stride = static_cast<std::ptrdiff_t>(map.step1());
  for (std::size_t l = 0; l < 4; ++l) {
    const float* at = first + p.offset[l];
    a[l] = at[0];
    b[l] = at[1];
    c[l] = at[stride];
    d[l] = at[stride + 1];
  }
  MapLookup out;
  for (std::size_t l = 0; l < 4; ++l) {
    const float above = a[l] + (b[l] - a[l]) * p.fx[l], below = c[l] + (d[l] - c[l]) * p.fx[l];
    out.value[l] = above + (below - above) * p.fy[l];
    out.by_y[l] = (below - above) * p.inside_y[l];
    out.by_x[l] = ((b[l] - a[l]) * (1 - p.fy[l]) + (d[l] - c[l]) * p.fy[l]) * p.inside_x[l];
  }
  return out;
}

/// sum_i basis_i c_i at four points.
void combine(const Lanes (&basis)[4], const std::array<float, 4>& c, Lanes& out) {
  for (std::size_t l = 0; l < 4; ++l)
    out[l] = basis[0][l] * c[0] + basis[1][l] * c[1] + basis[2][l] * c[2] + basis[3][l] * c[3];
}

float sum(const Lanes& v) {
  return (v[0] + v[1]) + (v[2] + v[3]);
}

glm::dvec2 combine(const SplineBasis& b, const std::array<double, 4>& weight,
                   const std::vector<glm::dvec2>& control) {
  glm::dvec2 sum(0);
  for (std::size_t k = 0; k < 4; ++k) sum += weight[k] * control[static_cast<std::size_t>(b.control[k])];
  return sum;
}

double dot(glm::dvec2 a, glm::dvec2 b) {
  return a.x * b.x + a.y * b.y;
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
  const auto n = static_cast<std::size_t>(controls);
  for (auto& g : gram_) g.assign(n * n, 0.0);
  for (const SplineBasis& b : points_) {
    const std::array<const std::array<double, 4>*, 3> weight = {&b.value, &b.d1, &b.d2};
    for (std::size_t derivative = 0; derivative < 3; ++derivative)
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
          gram_[derivative]
               [static_cast<std::size_t>(b.control[i]) * n + static_cast<std::size_t>(b.control[j])] +=
              (*weight[derivative])[i] * (*weight[derivative])[j];
  }
  for (std::size_t h = 0, in_quad = 4; h < points_.size(); ++h, ++in_quad) {
    const SplineBasis& b = points_[h];
    if (in_quad == 4 || quads_.back().control != b.control) {
      quads_.push_back({b.control, {}, {}, {}});
      in_quad = 0;
    }
    for (std::size_t l = in_quad; l < 4; ++l) {
      for (std::size_t k = 0; k < 4; ++k) {
        quads_.back().value[k][l] = static_cast<float>(b.value[k]);
        quads_.back().d1[k][l] = static_cast<float>(b.d1[k]);
      }
      quads_.back().say[l] = l == in_quad ? 1.0F : 0.0F;
    }
  }
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
      quadratic_(curve.gram(0).size()),
      linear_(static_cast<std::size_t>(curve.controls()), glm::dvec2(0)) {
  const std::size_t n = linear_.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const double temporal = weights.temporal * curve.gram(0)[i * n + j];  // eq. 5: |v - v(t - 1)|^2
      const double shape = weights.shape * curve.gram(1)[i * n + j];        // |v_s - r_s|^2
      quadratic_[i * n + j] = temporal + shape +
                              weights.tension * curve.gram(1)[i * n + j] +  // eq. 3: |v_s|^2
                              weights.rigidity * curve.gram(2)[i * n + j];  // eq. 4: |v_ss|^2
      linear_[i] += temporal * before[j] + shape * rest[j];
      constant_ += temporal * dot(before[i], before[j]) + shape * dot(rest[i], rest[j]);
    }
  }
}

double BSnake::internal(const Vectors& control, Vectors* gradient) const {
  const std::size_t n = control.size();
  double energy = constant_;
  for (std::size_t i = 0; i < n; ++i) {
    glm::dvec2 row(0);
    for (std::size_t j = 0; j < n; ++j) row += quadratic_[i * n + j] * control[j];
    energy += dot(control[i], row - 2.0 * linear_[i]);
    if (gradient != nullptr) (*gradient)[i] += 2.0 * (row - linear_[i]);
  }
  return energy;
}

double BSnake::repulsion(const Vectors& control, Vectors* gradient) const {
  if (weights_.repulsion == 0) return 0;
  double energy = 0;
  for (const FacingPair& pair : facing_) {
    // Quadratic in what the gap falls short of the least one. The gap is signed, so that points that have
    // crossed are driven apart again and not farther through each other.
    const SplineBasis& from = curve_.points()[static_cast<std::size_t>(pair.from)];
    const SplineBasis& to = curve_.points()[static_cast<std::size_t>(pair.to)];
    const double lacks =
        pair.least_gap - dot(curve_point(to, control) - curve_point(from, control), pair.direction);
    if (lacks <= 0) continue;
    energy += weights_.repulsion * lacks * lacks;
    if (gradient == nullptr) continue;
    const glm::dvec2 slope = -2 * weights_.repulsion * lacks * pair.direction;
    for (std::size_t k = 0; k < 4; ++k) {
      (*gradient)[static_cast<std::size_t>(to.control[k])] += to.value[k] * slope;
      (*gradient)[static_cast<std::size_t>(from.control[k])] -= from.value[k] * slope;
    }
  }
  return energy;
}

double BSnake::external(const Vectors& control, Vectors* gradient) const {
  const bool ridge = !image_.ridge.empty(), changes = weights_.change != 0;
  if (weights_.contrast == 0 && !changes) return 0;
  const auto scale = static_cast<float>(image_.px_per_unit);
  const auto origin_x = static_cast<float>(image_.origin.x), origin_y = static_cast<float>(image_.origin.y);
  const auto contrast_weight = static_cast<float>(weights_.contrast);
  const auto change_weight = static_cast<float>(weights_.change);
  double contrast = 0, change = 0;
  for (const PointQuad& q : curve_.quads()) {
    std::array<float, 4> x, y;
    for (std::size_t k = 0; k < 4; ++k) {
      const glm::dvec2 c = control[static_cast<std::size_t>(q.control[k])];
      x[k] = static_cast<float>(c.x);
      y[k] = static_cast<float>(c.y);
    }
    alignas(16) Lanes vx, vy, vs_x, vs_y;
    combine(q.value, x, vx);
    combine(q.value, y, vy);
    combine(q.d1, x, vs_x);
    combine(q.d1, y, vs_y);
    for (std::size_t l = 0; l < 4; ++l) {
      vx[l] = (vx[l] - origin_x) * scale;
      vy[l] = (vy[l] - origin_y) * scale;
    }
    const MapPlace at = place(ridge ? image_.ridge : image_.contrast_x, vx, vy);
    alignas(16) Lanes h, h_by_x, h_by_y, h_by_vs_x{}, h_by_vs_y{};
    if (ridge) {
      const MapLookup r = look_up(image_.ridge, at);
      for (std::size_t l = 0; l < 4; ++l) {
        h[l] = r.value[l] * q.say[l];
        h_by_x[l] = r.by_x[l];
        h_by_y[l] = r.by_y[l];
      }
    } else {
      // The curve runs clockwise in the picture, so (vs.y, -vs.x) points outwards. The feature map is high
      // inside: the contrast that shows the contour is its fall along the normal.
      const MapLookup gx = look_up(image_.contrast_x, at), gy = look_up(image_.contrast_y, at);
      for (std::size_t l = 0; l < 4; ++l) {
        const float per_length = 1 / (std::sqrt(vs_x[l] * vs_x[l] + vs_y[l] * vs_y[l]) + 1e-9F);
        const float tx = vs_x[l] * per_length, ty = vs_y[l] * per_length;
        const float along = gy.value[l] * tx - gx.value[l] * ty;
        h[l] = along * q.say[l];
        h_by_x[l] = gy.by_x[l] * tx - gx.by_x[l] * ty;
        h_by_y[l] = gy.by_y[l] * tx - gx.by_y[l] * ty;
        h_by_vs_x[l] = (gy.value[l] - along * tx) * per_length;
        h_by_vs_y[l] = (-gx.value[l] - along * ty) * per_length;
      }
    }
    contrast += static_cast<double>(sum(h));
    MapLookup c{};
    if (changes) {
      c = look_up(image_.change, at);
      for (std::size_t l = 0; l < 4; ++l) c.value[l] *= q.say[l];
      change += static_cast<double>(sum(c.value));
    }
    if (gradient == nullptr) continue;
    alignas(16) Lanes by_x, by_y;
    for (std::size_t l = 0; l < 4; ++l) {
      by_x[l] = (contrast_weight * h_by_x[l] + change_weight * c.by_x[l]) * scale * q.say[l];
      by_y[l] = (contrast_weight * h_by_y[l] + change_weight * c.by_y[l]) * scale * q.say[l];
      h_by_vs_x[l] *= contrast_weight * q.say[l];
      h_by_vs_y[l] *= contrast_weight * q.say[l];
    }
    for (std::size_t k = 0; k < 4; ++k) {
      alignas(16) Lanes gx, gy;
      for (std::size_t l = 0; l < 4; ++l) {
        gx[l] = q.value[k][l] * by_x[l] + q.d1[k][l] * h_by_vs_x[l];
        gy[l] = q.value[k][l] * by_y[l] + q.d1[k][l] * h_by_vs_y[l];
      }
      (*gradient)[static_cast<std::size_t>(q.control[k])] -= glm::dvec2(sum(gx), sum(gy));
    }
  }
  return -weights_.contrast * contrast - weights_.change * change;
}

double BSnake::evaluate(const Vectors& control, Vectors* gradient) const {
  if (gradient != nullptr) gradient->assign(control.size(), glm::dvec2(0));
  return internal(control, gradient) + repulsion(control, gradient) + external(control, gradient);
}

double BSnake::energy(const std::vector<glm::dvec2>& control) const {
  return evaluate(control, nullptr) * curve_.ds();
}

std::vector<glm::dvec2> BSnake::gradient(const std::vector<glm::dvec2>& control) const {
  Vectors out;
  (void)evaluate(control, &out);
  for (glm::dvec2& g : out) g *= curve_.ds();
  return out;
}

SnakeOutcome BSnake::minimise(std::vector<glm::dvec2> start) const {
  const auto against = [](double slope) { return slope > kFlat ? -1.0 : slope < -kFlat ? 1.0 : 0.0; };
  SnakeOutcome out{std::move(start), 0, 0, 0};
  SnakeOutcome best = out;
  Vectors gradient, descent_start;
  for (int restart = 0; restart <= kMaxRestarts; ++restart) {
    double delta = kDelta0;
    descent_start = out.control;
    out.energy = evaluate(out.control, &gradient) * curve_.ds();
    if (restart == 0) best.energy = out.energy;
    for (int q = 0; q < kMaxIterations; ++q, delta *= kSigma) {
      for (int k = curve_.first_free(); k < curve_.end_free(); ++k) {
        const auto i = static_cast<std::size_t>(k);
        out.control[i] += delta * glm::dvec2(against(gradient[i].x), against(gradient[i].y));
      }
      const double now = evaluate(out.control, &gradient) * curve_.ds();
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
    for (std::size_t i = 0; i < best.control.size(); ++i) {
      const glm::dvec2 way = best.control[i] - descent_start[i];
      farthest = std::max(farthest, dot(way, way));
    }
    if (farthest < kNearlyFullReach * kNearlyFullReach) break;
    out.control = best.control;
  }
  return best;
}

}  // namespace fbs
