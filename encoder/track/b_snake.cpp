#include "encoder/track/b_snake.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/hal/intrin.hpp>

namespace fbs {
namespace {

constexpr double kDelta0 = 1.0;  // snake units
constexpr double kSigma = 0.75;
constexpr int kMaxIterations = 15;
constexpr int kMaxRestarts = 2;
constexpr double kStopChange = 2e-4;      // of the energy, from iteration to iteration
constexpr double kNearlyFullReach = 3.0;  // snake units; the steps sum to delta_0 / (1 - sigma) = 4
constexpr double kFlat = 1e-7;  // energy per snake unit; a slope below this is rounding and no direction

using Four = cv::v_float32x4;  // one number of each of four points

/// A map's bilinear value at four points and its slopes, per sample of the map.
struct MapLookup {
  Four value, by_x, by_y;
};

/// Where four points lie in maps of one size.
struct MapPlace {
  std::array<std::ptrdiff_t, 4> first;  ///< index of the sample above and to the left
  std::ptrdiff_t stride;
  Four fx, fy;
  Four inside_x, inside_y;  ///< 1, or 0 where the map's border is repeated and nothing slopes

  MapPlace(const cv::Mat1f& map, const Four& x, const Four& y) : stride(map.cols) {
    const Four zero = cv::v_setzero_f32(), one = cv::v_setall_f32(1);
    const Four cx = cv::v_min(cv::v_max(x, zero), cv::v_setall_f32(static_cast<float>(map.cols) - 1.001F));
    const Four cy = cv::v_min(cv::v_max(y, zero), cv::v_setall_f32(static_cast<float>(map.rows) - 1.001F));
    const cv::v_int32x4 i = cv::v_trunc(cx), j = cv::v_trunc(cy);
    alignas(16) int column[4], row[4];
    cv::v_store_aligned(column, i);
    cv::v_store_aligned(row, j);
    for (std::size_t l = 0; l < 4; ++l) first[l] = row[l] * stride + column[l];
    fx = cx - cv::v_cvt_f32(i);
    fy = cy - cv::v_cvt_f32(j);
    inside_x = (cx == x) & one;
    inside_y = (cy == y) & one;
  }

  [[nodiscard]] MapLookup in(const cv::Mat1f& map) const {
    const float* data = map[0];
    const float *p0 = data + first[0], *p1 = data + first[1], *p2 = data + first[2], *p3 = data + first[3];
    const auto all = [&](std::ptrdiff_t k) { return Four(p0[k], p1[k], p2[k], p3[k]); };
    const Four a = all(0), along = all(1) - a, c = all(stride), along_below = all(stride + 1) - c;
    const Four above = a + along * fx, down = c + along_below * fx - above;
    return {above + down * fy, (along + (along_below - along) * fy) * inside_x, down * inside_y};
  }
};

/// sum_i basis_i c_i at four points.
Four combine(const float (&basis)[4][4], const std::array<Four, 4>& c) {
  return cv::v_load_aligned(basis[0]) * c[0] + cv::v_load_aligned(basis[1]) * c[1] +
         cv::v_load_aligned(basis[2]) * c[2] + cv::v_load_aligned(basis[3]) * c[3];
}

glm::dvec2 combine(const SplineBasis& b, const std::array<double, 4>& weight,
                   const std::vector<glm::dvec2>& control) {
  glm::dvec2 sum(0);
  for (std::size_t k = 0; k < 4; ++k) sum += weight[k] * control[b.control[k]];
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
        support_[points_[h].control[k]].push_back(static_cast<int>(h));
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
    const SplineBasis& from = curve_.points()[pair.from];
    const SplineBasis& to = curve_.points()[pair.to];
    const double lacks =
        pair.least_gap - dot(curve_point(to, control) - curve_point(from, control), pair.direction);
    if (lacks <= 0) continue;
    energy += weights_.repulsion * lacks * lacks;
    if (gradient == nullptr) continue;
    const glm::dvec2 slope = -2 * weights_.repulsion * lacks * pair.direction;
    for (std::size_t k = 0; k < 4; ++k) {
      (*gradient)[to.control[k]] += to.value[k] * slope;
      (*gradient)[from.control[k]] -= from.value[k] * slope;
    }
  }
  return energy;
}

double BSnake::external(const Vectors& control, Vectors* gradient) const {
  const bool ridge = !image_.ridge.empty(), changes = weights_.change != 0;
  if (weights_.contrast == 0 && !changes) return 0;
  const Four scale = cv::v_setall_f32(static_cast<float>(image_.px_per_unit));
  const Four origin_x = cv::v_setall_f32(static_cast<float>(image_.origin.x));
  const Four origin_y = cv::v_setall_f32(static_cast<float>(image_.origin.y));
  const Four contrast_weight = cv::v_setall_f32(static_cast<float>(weights_.contrast));
  const Four change_weight = cv::v_setall_f32(static_cast<float>(weights_.change));
  Four contrast = cv::v_setzero_f32(), change = cv::v_setzero_f32();
  for (const PointQuad& q : curve_.quads()) {
    std::array<Four, 4> x, y;
    for (std::size_t k = 0; k < 4; ++k) {
      const glm::dvec2 c = control[q.control[k]];
      x[k] = cv::v_setall_f32(static_cast<float>(c.x));
      y[k] = cv::v_setall_f32(static_cast<float>(c.y));
    }
    const Four say = cv::v_load_aligned(q.say), vs_x = combine(q.d1, x), vs_y = combine(q.d1, y);
    const MapPlace at(ridge ? image_.ridge : image_.contrast_x, (combine(q.value, x) - origin_x) * scale,
                      (combine(q.value, y) - origin_y) * scale);
    MapLookup h;
    Four h_by_vs_x = cv::v_setzero_f32(), h_by_vs_y = h_by_vs_x;
    if (ridge) {
      h = at.in(image_.ridge);
    } else {
      // The curve runs clockwise in the picture, so (vs.y, -vs.x) points outwards. The feature map is high
      // inside: the contrast that shows the contour is its fall along the normal.
      const MapLookup gx = at.in(image_.contrast_x), gy = at.in(image_.contrast_y);
      const Four length = cv::v_sqrt(vs_x * vs_x + vs_y * vs_y) + cv::v_setall_f32(1e-9F);
      const Four per_length = cv::v_setall_f32(1) / length, tx = vs_x * per_length, ty = vs_y * per_length;
      h = {gy.value * tx - gx.value * ty, gy.by_x * tx - gx.by_x * ty, gy.by_y * tx - gx.by_y * ty};
      h_by_vs_x = (gy.value - h.value * tx) * per_length;
      h_by_vs_y = (cv::v_setzero_f32() - gx.value - h.value * ty) * per_length;
    }
    contrast += h.value * say;
    Four by_x = contrast_weight * h.by_x, by_y = contrast_weight * h.by_y;
    if (changes) {
      const MapLookup c = at.in(image_.change);
      change += c.value * say;
      by_x += change_weight * c.by_x;
      by_y += change_weight * c.by_y;
    }
    if (gradient == nullptr) continue;
    by_x *= scale * say;
    by_y *= scale * say;
    h_by_vs_x *= contrast_weight * say;
    h_by_vs_y *= contrast_weight * say;
    for (std::size_t k = 0; k < 4; ++k) {
      const Four value = cv::v_load_aligned(q.value[k]), d1 = cv::v_load_aligned(q.d1[k]);
      (*gradient)[q.control[k]] -= glm::dvec2(cv::v_reduce_sum(value * by_x + d1 * h_by_vs_x),
                                              cv::v_reduce_sum(value * by_y + d1 * h_by_vs_y));
    }
  }
  return -weights_.contrast * static_cast<double>(cv::v_reduce_sum(contrast)) -
         weights_.change * static_cast<double>(cv::v_reduce_sum(change));
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
