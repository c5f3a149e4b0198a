#include "encoder/track/snake/snake_curve.h"

#include <utility>

namespace fbs {
namespace {

std::vector<double> gram_of(const std::vector<SplineBasis>& points,
                            std::array<double, 4> SplineBasis::*weight, std::size_t controls) {
  std::vector<double> out(controls * controls, 0.0);
  for (const SplineBasis& b : points)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        out[b.control[i] * controls + b.control[j]] += (b.*weight)[i] * (b.*weight)[j];
  return out;
}

std::vector<PointQuad> quads_of(const std::vector<SplineBasis>& points) {
  std::vector<PointQuad> quads;
  std::size_t in_quad = 4;
  for (const SplineBasis& b : points) {
    if (in_quad == 4 || quads.back().control != b.control) {
      quads.push_back({b.control, {}, {}, {}});
      in_quad = 0;
    }
    for (std::size_t l = in_quad; l < 4; ++l) {
      for (std::size_t k = 0; k < 4; ++k) {
        quads.back().value[k][l] = static_cast<float>(b.value[k]);
        quads.back().d1[k][l] = static_cast<float>(b.d1[k]);
      }
      quads.back().weight[l] = l == in_quad ? 1.0F : 0.0F;
    }
    ++in_quad;
  }
  return quads;
}

}  // namespace

glm::dvec2 curve_point(const SplineBasis& basis, const std::vector<glm::dvec2>& control) {
  glm::dvec2 sum(0);
  for (std::size_t k = 0; k < 4; ++k) sum += basis.value[k] * control[basis.control[k]];
  return sum;
}

SplineBasis basis_at(const SnakeCurve& curve, double s) {
  return curve.is_closed() ? closed_basis(curve.controls(), s) : clamped_basis(true, s);
}

SnakeCurve::SnakeCurve(bool is_closed, int controls, int pinned, std::vector<SplineBasis> points, double ds)
    : closed_(is_closed),
      controls_(controls),
      pinned_(pinned),
      points_(std::move(points)),
      quads_(quads_of(points_)),
      gram_{gram_of(points_, &SplineBasis::value, controls), gram_of(points_, &SplineBasis::d1, controls),
            gram_of(points_, &SplineBasis::d2, controls)},
      ds_(ds) {}

SnakeCurve SnakeCurve::closed(int controls, int points) {
  std::vector<SplineBasis> basis;
  basis.reserve(points);
  const double ds = static_cast<double>(controls) / points;
  for (int h = 0; h < points; ++h) basis.push_back(closed_basis(controls, h * ds));
  return {true, controls, 0, std::move(basis), ds};
}

SnakeCurve SnakeCurve::clamped(int points, bool free_ends) {
  std::vector<SplineBasis> basis;
  basis.reserve(points);
  const double ds = 1.0 / (points - 1);
  for (int h = 0; h < points; ++h) basis.push_back(clamped_basis(true, h * ds));
  return {false, 4, free_ends ? 0 : 1, std::move(basis), ds};
}

}  // namespace fbs
