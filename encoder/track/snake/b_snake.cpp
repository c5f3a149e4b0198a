#include "encoder/track/snake/b_snake.h"

#include "encoder/track/snake/map_lookup.h"

namespace fbs {
namespace {

/// sum_i basis_i c_i at four points.
Four combine(const float (&basis)[4][4], const std::array<Four, 4>& c) {
  return cv::v_load_aligned(basis[0]) * c[0] + cv::v_load_aligned(basis[1]) * c[1] +
         cv::v_load_aligned(basis[2]) * c[2] + cv::v_load_aligned(basis[3]) * c[3];
}

Four all_four(double v) {
  return cv::v_setall_f32(static_cast<float>(v));
}

/// H at four points, with its slopes over their places and over v_s.
struct Contrast {
  MapLookup at;
  Four by_vs_x, by_vs_y;
};

Contrast ridge_at(const MapPlace& at, const SnakeImage& image) {
  return {at.in(image.ridge), cv::v_setzero_f32(), cv::v_setzero_f32()};
}

/// The curve runs clockwise in the picture, so (vs.y, -vs.x) points outwards. The feature map is high inside:
/// a contour's contrast is the fall along the normal.
Contrast contour_at(const MapPlace& at, const SnakeImage& image, const Four& vs_x, const Four& vs_y) {
  const MapLookup gx = at.in(image.contrast_x), gy = at.in(image.contrast_y);
  const Four length = cv::v_sqrt(vs_x * vs_x + vs_y * vs_y) + cv::v_setall_f32(1e-9F);
  const Four per_length = cv::v_setall_f32(1) / length, tx = vs_x * per_length, ty = vs_y * per_length;
  const MapLookup h = {gy.value * tx - gx.value * ty, gy.by_x * tx - gx.by_x * ty,
                       gy.by_y * tx - gx.by_y * ty};
  return {h, (gy.value - h.value * tx) * per_length,
          (cv::v_setzero_f32() - gx.value - h.value * ty) * per_length};
}

/// Distributes slopes by the positions of four points and by their v_s to the control points that move them.
void subtract(const PointQuad& q, const std::array<Four, 2>& by_place, const std::array<Four, 2>& by_vs,
              std::vector<glm::dvec2>& gradient) {
  for (std::size_t k = 0; k < 4; ++k) {
    const Four value = cv::v_load_aligned(q.value[k]), d1 = cv::v_load_aligned(q.d1[k]);
    gradient[q.control[k]] -= glm::dvec2(cv::v_reduce_sum(value * by_place[0] + d1 * by_vs[0]),
                                         cv::v_reduce_sum(value * by_place[1] + d1 * by_vs[1]));
  }
}

double dot(glm::dvec2 a, glm::dvec2 b) {
  return a.x * b.x + a.y * b.y;
}

}  // namespace

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
    // Quadratic in how far the gap falls short of its minimum. The gap is signed, so that crossed points are
    // driven apart again and not farther through each other.
    const SplineBasis& from = curve_.points()[pair.from];
    const SplineBasis& to = curve_.points()[pair.to];
    const double lacks =
        pair.min_gap - dot(curve_point(to, control) - curve_point(from, control), pair.direction);
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
  if (weights_.contrast == 0) return 0;
  const bool ridge = !image_.ridge.empty();
  const Four scale = all_four(image_.px_per_unit);
  const Four origin_x = all_four(image_.origin.x), origin_y = all_four(image_.origin.y);
  const Four contrast_weight = all_four(weights_.contrast);
  Four contrast = cv::v_setzero_f32();
  for (const PointQuad& q : curve_.quads()) {
    std::array<Four, 4> x, y;
    for (std::size_t k = 0; k < 4; ++k) {
      x[k] = all_four(control[q.control[k]].x);
      y[k] = all_four(control[q.control[k]].y);
    }
    const Four weight = cv::v_load_aligned(q.weight);
    const MapPlace at(ridge ? image_.ridge : image_.contrast_x, (combine(q.value, x) - origin_x) * scale,
                      (combine(q.value, y) - origin_y) * scale);
    const Contrast h =
        ridge ? ridge_at(at, image_) : contour_at(at, image_, combine(q.d1, x), combine(q.d1, y));
    contrast += h.at.value * weight;
    if (gradient == nullptr) continue;
    const Four place_weight = contrast_weight * scale * weight;
    subtract(q, {h.at.by_x * place_weight, h.at.by_y * place_weight},
             {h.by_vs_x * (contrast_weight * weight), h.by_vs_y * (contrast_weight * weight)}, *gradient);
  }
  return -weights_.contrast * static_cast<double>(cv::v_reduce_sum(contrast));
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

}  // namespace fbs
