#include "encoder/fit/normal_equations.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fbs {

NormalEquations::NormalEquations(int unknowns)
    : n_(unknowns),
      left_(static_cast<std::size_t>(unknowns) * static_cast<std::size_t>(unknowns)),
      right_(static_cast<std::size_t>(unknowns)) {}

void NormalEquations::add_prior(std::size_t k, double off, double sigma) {
  left(k, k) += 1 / (sigma * sigma);
  right_[k] -= off / (sigma * sigma);
}

cv::Mat1d NormalEquations::symmetric() {
  cv::Mat1d all(n_, n_, left_.data());
  cv::completeSymm(all);
  return all;
}

bool NormalEquations::factorise() {
  const auto n = right_.size();
  for (std::size_t j = 0; j < n; ++j) {
    double* out = &left(j, 0);
    std::size_t k = 0;
    for (; k + 4 <= j; k += 4) {
      const double *a = &left(k, 0), *b = a + n, *c = b + n, *d = c + n;
      const double fa = a[j], fb = b[j], fc = c[j], fd = d[j];
      for (std::size_t i = j; i < n; ++i) out[i] = out[i] - fa * a[i] - fb * b[i] - fc * c[i] - fd * d[i];
    }
    for (; k < j; ++k) {
      const double* a = &left(k, 0);
      const double fa = a[j];
      for (std::size_t i = j; i < n; ++i) out[i] -= fa * a[i];
    }
    if (out[j] < std::numeric_limits<double>::epsilon()) return false;
    out[j] = 1 / std::sqrt(out[j]);
    for (std::size_t i = j + 1; i < n; ++i) out[i] *= out[j];
  }
  return true;
}

std::optional<cv::Mat1d> NormalEquations::solve() {
  if (!factorise()) return std::nullopt;
  cv::Mat1d x(n_, 1);
  std::ranges::copy(right_, x.begin());
  double* out = x[0];
  const auto n = right_.size();
  for (std::size_t k = 0; k < n; ++k) {
    const double* row = &left(k, 0);
    out[k] *= row[k];
    for (std::size_t i = k + 1; i < n; ++i) out[i] -= row[i] * out[k];
  }
  for (std::size_t i = n; i-- > 0;) {
    const double* row = &left(i, 0);
    for (std::size_t k = n; --k > i;) out[i] -= row[k] * out[k];
    out[i] *= row[i];
  }
  return x;
}

}  // namespace fbs
