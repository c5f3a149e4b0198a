// Robust costs: how much a residual counts when it may be an outlier.
//
// q is the squared residual in units of the outlier scale: r^2 / sigma^2.
#pragma once

namespace fbs {

/// Geman & McClure (1987): r^2 near zero, and never more than sigma^2.
template <class Real>
[[nodiscard]] constexpr Real geman_mcclure(Real squared_residual, Real squared_sigma) {
  return squared_residual / (1 + squared_residual / squared_sigma);
}

/// Reciprocal of geman_mcclure_weight(): loops over many points divide by it once.
template <class Real>
[[nodiscard]] constexpr Real geman_mcclure_divisor(Real q) {
  const Real d = 1 + q;
  return d * d;
}

/// Weight of a residual in reweighted least squares, 1 at zero.
template <class Real>
[[nodiscard]] constexpr Real geman_mcclure_weight(Real q) {
  return 1 / geman_mcclure_divisor(q);
}

/// The same for Cauchy's cost log(1 + q), which keeps some weight for far residuals.
template <class Real>
[[nodiscard]] constexpr Real cauchy_weight(Real q) {
  return 1 / (1 + q);
}

}  // namespace fbs
