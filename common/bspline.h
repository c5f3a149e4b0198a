// Cubic B-splines of the features: x(s) = sum X_i B_i(s), paper section 2.
#pragma once

#include <array>
#include <cmath>

namespace fbs {

/// The basis functions that are not zero at one s, at most four, with first and second derivatives.
struct SplineBasis {
  std::array<int, 4> control{-1, -1, -1, -1};  ///< index of the control point; -1: pinned
  std::array<double, 4> value{};               ///< B_i(s)
  std::array<double, 4> d1{};                  ///< dB_i/ds
  std::array<double, 4> d2{};                  ///< d2B_i/ds2
};

/// Closed uniform cubic B-spline; B_i is centred on s = i.
/// @param s  any number; the period is `count`
[[nodiscard]] inline SplineBasis closed_basis(int count, double s) {
  const double wrapped = s - count * std::floor(s / count);
  const int span = static_cast<int>(wrapped) % count;
  const double t = wrapped - std::floor(wrapped), r = 1 - t;
  SplineBasis b;
  for (int k = 0; k < 4; ++k) b.control[k] = (span + k - 1 + count) % count;
  b.value = {r * r * r / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6,
             t * t * t / 6};
  b.d1 = {-r * r / 2, (3 * t * t - 4 * t) / 2, (-3 * t * t + 2 * t + 1) / 2, t * t / 2};
  b.d2 = {r, 3 * t - 2, -3 * t + 1, t};
  return b;
}

/// Clamped cubic with four control points (one span: the Bernstein polynomials), s in 0..1.
/// @param free_ends  false: the first and the last control point are pinned and the inner two are 0 and 1
[[nodiscard]] inline SplineBasis clamped_basis(bool free_ends, double s) {
  const double t = s, r = 1 - s;
  SplineBasis b;
  b.control = free_ends ? std::array<int, 4>{0, 1, 2, 3} : std::array<int, 4>{-1, 0, 1, -1};
  b.value = {r * r * r, 3 * r * r * t, 3 * r * t * t, t * t * t};
  b.d1 = {-3 * r * r, 3 * r * r - 6 * r * t, 6 * r * t - 3 * t * t, 3 * t * t};
  b.d2 = {6 * r, -12 * r + 6 * t, 6 * r - 12 * t, 6 * t};
  return b;
}

}  // namespace fbs
