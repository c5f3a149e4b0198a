// Weighted linear least squares, accumulated row by row.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace fbs {

/// left x = right.
class NormalEquations {
 public:
  explicit NormalEquations(int unknowns);

  [[nodiscard]] int unknowns() const { return n_; }
  /// Only the upper triangle, row <= column, counts.
  double& left(std::size_t row, std::size_t column) {
    return left_[row * static_cast<std::size_t>(n_) + column];
  }
  double& right(std::size_t row) { return right_[row]; }

  /// Adds the prior that unknown k, now `off` from its mean, lies there to within sigma.
  void add_prior(std::size_t k, double off, double sigma);

  /// The whole symmetric left side. Borrows this.
  [[nodiscard]] cv::Mat1d symmetric();
  /// By Cholesky's method, in the order of OpenCV's, whose last bits streams depend on, but several sums at a
  /// time. Leaves the left side undefined.
  /// @return nothing when the left side is not positive definite
  [[nodiscard]] std::optional<cv::Mat1d> solve();

 private:
  /// Left becomes U of U^T U, its diagonal inverted. @return false when there is none
  bool factorise();

  int n_;
  std::vector<double> left_, right_;
};

}  // namespace fbs
