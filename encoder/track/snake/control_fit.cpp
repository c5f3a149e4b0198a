#include "encoder/track/snake/control_fit.h"

namespace fbs {
namespace {

constexpr double kRigidity = 1e-4;  // weight: decides only what the vertices leave open
constexpr double kPinned = 1e6;     // weight: as good as fixed

}  // namespace

void ControlFit::add(const SplineBasis& basis, const std::array<double, 4>& shares, double weight,
                     glm::dvec2 value) {
  for (std::size_t i = 0; i < 4; ++i) {
    b_(basis.control[i], 0) += weight * shares[i] * value.x;
    b_(basis.control[i], 1) += weight * shares[i] * value.y;
    for (std::size_t j = 0; j < 4; ++j)
      a_(basis.control[i], basis.control[j]) += weight * shares[i] * shares[j];
  }
}

void ControlFit::add(int control, double weight, glm::dvec2 value) {
  a_(control, control) += weight;
  b_(control, 0) += weight * value.x;
  b_(control, 1) += weight * value.y;
}

std::vector<glm::dvec2> ControlFit::solve() const {
  cv::Mat1d x;
  cv::solve(a_, b_, x, cv::DECOMP_CHOLESKY);
  std::vector<glm::dvec2> control;
  control.reserve(x.rows);
  for (int i = 0; i < x.rows; ++i) control.emplace_back(x(i, 0), x(i, 1));
  return control;
}

std::vector<glm::dvec2> fit_control(const Feature& f, const SnakeCurve& curve,
                                    std::span<const glm::dvec2> target,
                                    const std::array<glm::dvec2, 2>& ends) {
  ControlFit fit(curve.controls());
  for (std::size_t k = 0; k < f.vertices.size(); ++k) {
    const SplineBasis basis = basis_at(curve, static_cast<double>(f.vertices[k].s));
    fit.add(basis, basis.value, 1, target[k]);
  }
  for (const SplineBasis& basis : curve.points()) fit.add(basis, basis.d2, kRigidity, {0, 0});
  if (curve.first_free() > 0) {
    fit.add(0, kPinned, ends[0]);
    fit.add(curve.controls() - 1, kPinned, ends[1]);
  }
  return fit.solve();
}

}  // namespace fbs
