#include "decoder/expression/expression_targets.h"

#include <algorithm>
#include <cmath>

#include "decoder/expression/face_movements.h"

namespace fbs {
namespace {

/// The inner lips say whether a mouth is open; the outer ones, drawn out by a beard or a shadow, must not
/// overrule them.
constexpr double kInnerLipMetric = 4;

/// Metric of a control point itself, so that no direction has length zero; a vertex on the control's feature
/// weighs about one.
constexpr double kControlMetric = 1e-3;

/// Largest control point offset in a detail at a weight of one, head units.
constexpr double kDetailSize = kUnitsPerEyeDistance / 16.0;

/// A unit vector with less than this left outside the directions already used depends on them: the rest is
/// rounding.
constexpr double kDependent = 1e-6;

/// @param a, b  x0, y0, x1 ...
double product(const std::vector<std::vector<double>>& metric, const std::vector<double>& a,
               const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < metric.size(); ++i)
    for (std::size_t j = 0; j < metric.size(); ++j)
      sum += metric[i][j] * (a[2 * i] * b[2 * j] + a[2 * i + 1] * b[2 * j + 1]);
  return sum;
}

/// Metric of two control points: the product of their displacements of the vertices on the features.
std::vector<std::vector<double>> vertex_metric(const WireFrame& head, std::size_t first, std::size_t count) {
  std::vector<std::vector<double>> metric(count, std::vector<double>(count));
  for (std::size_t i = 0; i < count; ++i) metric[i][i] = kControlMetric;
  for (std::size_t f = 0; f < kFeatureCount; ++f) {
    const auto id = static_cast<FeatureId>(f);
    const double weight = id == FeatureId::kMouthInner ? kInnerLipMetric : 1;
    for (const FeatureVertex& v : head.feature(id).vertices)
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < count; ++j)
          metric[i][j] += weight * skinning_weight(head, v.vertex, first + i) *
                          skinning_weight(head, v.vertex, first + j);
  }
  return metric;
}

std::vector<double> numbers_of(const ControlOffsets& offsets, std::size_t first, std::size_t count) {
  std::vector<double> out;
  for (std::size_t c = first; c < first + count; ++c) {
    out.push_back(offsets[c].x);
    out.push_back(offsets[c].y);
  }
  return out;
}

ControlOffsets offsets_of(const std::vector<double>& numbers, std::size_t first) {
  ControlOffsets out{};
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) out[first + i / 2] = {numbers[i], numbers[i + 1]};
  return out;
}

/// Gram-Schmidt: removes the directions from `v`, twice to limit rounding.
/// @return coordinates of `v` in the directions, and the length of the remainder
std::vector<double> orthogonalise(const std::vector<std::vector<double>>& metric,
                                  const std::vector<std::vector<double>>& directions,
                                  std::vector<double>& v) {
  std::vector<double> coordinates(directions.size());
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t k = 0; k < directions.size(); ++k) {
      const double share = product(metric, directions[k], v);
      coordinates[k] += share;
      for (std::size_t i = 0; i < v.size(); ++i) v[i] -= share * directions[k][i];
    }
  coordinates.push_back(std::sqrt(product(metric, v, v)));
  return coordinates;
}

void scale_by(std::vector<double>& v, double factor) {
  for (double& x : v) x *= factor;
}

/// Scale of a detail at a weight of one, in units of its orthonormal direction.
double detail_scale(const std::vector<double>& direction) {
  double largest = 0;
  for (const double x : direction) largest = std::max(largest, std::abs(x));
  return kDetailSize / largest;
}

}  // namespace

ExpressionTargets::Part ExpressionTargets::make_part(const WireFrame& head, const ExpressionPart& expression,
                                                     std::span<const ControlOffsets> movements) {
  Part part;
  part.first = expression.first_control;
  const std::size_t n = 2U * expression.control_count;
  part.metric = vertex_metric(head, part.first, expression.control_count);
  for (const ControlOffsets& movement : movements) {
    std::vector<double> v = numbers_of(movement, part.first, expression.control_count);
    part.triangle.push_back(orthogonalise(part.metric, part.orthonormal, v));
    scale_by(v, 1 / part.triangle.back().back());
    part.orthonormal.push_back(std::move(v));
  }
  // The basis of the stream is sorted by variance: the details that matter most come first.
  for (std::size_t row = 0; row < n && part.orthonormal.size() < n; ++row) {
    std::vector<double> v(expression.rows.begin() + static_cast<std::ptrdiff_t>(row * n),
                          expression.rows.begin() + static_cast<std::ptrdiff_t>((row + 1) * n));
    scale_by(v, 1 / std::sqrt(product(part.metric, v, v)));
    const double left = orthogonalise(part.metric, part.orthonormal, v).back();
    if (left < kDependent) continue;
    scale_by(v, 1 / left);
    part.orthonormal.push_back(std::move(v));
  }
  return part;
}

ExpressionTargets::ExpressionTargets(const Geometry& head) {
  const auto movements = face_movements(head);
  std::vector<ExpressionTarget> details;
  for (std::size_t p = 0; p < kExpressionPartCount; ++p) {
    const ExpressionPart& expression = generic_head().expression[p];
    parts_[p] = make_part(head.wire_frame(), expression, movements[p]);
    for (const NamedShape& shape : named_shapes()[p]) {
      ExpressionTarget target{std::string(shape.name), false, {}};
      for (std::size_t m = 0; m < movements[p].size(); ++m)
        for (std::size_t c = 0; c < kControlCount; ++c)
          target.offsets[c] += shape.amounts[m] * movements[p][m][c];
      targets_.push_back(std::move(target));
    }
    for (std::size_t k = movements[p].size(); k < parts_[p].orthonormal.size(); ++k) {
      std::vector<double> v = parts_[p].orthonormal[k];
      scale_by(v, detail_scale(v));
      details.push_back(
          {std::string(expression.name) + "_detail_" + std::to_string(k - movements[p].size() + 1), true,
           offsets_of(v, parts_[p].first)});
    }
  }
  named_count_ = targets_.size();
  std::move(details.begin(), details.end(), std::back_inserter(targets_));
}

std::vector<double> ExpressionTargets::coefficients(const Part& part, const State& state) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < part.metric.size(); ++i) {
    const glm::ivec2 c = state.control[part.first + i];
    numbers.insert(numbers.end(), {static_cast<double>(c.x), static_cast<double>(c.y)});
  }
  std::vector<double> out;
  for (const auto& direction : part.orthonormal) out.push_back(product(part.metric, direction, numbers));
  // The movements are not orthogonal: back substitution gives their amounts.
  for (std::size_t k = part.triangle.size(); k-- > 0;) {
    out[k] /= part.triangle[k][k];
    for (std::size_t j = 0; j < k; ++j) out[j] -= out[k] * part.triangle[k][j];
  }
  return out;
}

std::vector<double> ExpressionTargets::weights(const State& state) const {
  std::vector<double> named, details;
  for (std::size_t p = 0; p < kExpressionPartCount; ++p) {
    const Part& part = parts_[p];
    const std::vector<double> all = coefficients(part, state);
    const auto movements_end = all.begin() + static_cast<std::ptrdiff_t>(part.triangle.size());
    const std::vector<double> shapes = shape_weights(p, {all.begin(), movements_end});
    named.insert(named.end(), shapes.begin(), shapes.end());
    for (std::size_t k = part.triangle.size(); k < all.size(); ++k)
      details.push_back(all[k] / detail_scale(part.orthonormal[k]));
  }
  named.insert(named.end(), details.begin(), details.end());
  return named;
}

const std::vector<std::string>& blendshape_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (const auto& part : named_shapes())
      for (const NamedShape& s : part) out.emplace_back(s.name);
    return out;
  }();
  return names;
}

std::vector<double> BlendshapeMeasure::operator()(const Geometry& head, const State& state) {
  if (head_ != head) {
    head_ = head;
    targets_.emplace(head);
  }
  std::vector<double> weights = targets_->weights(state);
  weights.resize(targets_->named_count());
  return weights;
}

glm::dvec2 displacement(const ExpressionTarget& target, const WireFrame& head, std::size_t vertex) {
  glm::dvec2 sum{};
  for (const SkinningWeight& s : head.skinning_of(vertex))
    sum += s.weight / static_cast<double>(kSkinningOne) * target.offsets[s.control];
  return sum;
}

}  // namespace fbs
