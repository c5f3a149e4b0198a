#include "encoder/fit/normal_equations.h"

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

std::optional<cv::Mat1d> NormalEquations::solve() {
  const cv::Mat1d right(n_, 1, right_.data());
  cv::Mat1d x;
  if (!cv::solve(symmetric(), right, x, cv::DECOMP_CHOLESKY)) return std::nullopt;
  return x;
}

}  // namespace fbs
