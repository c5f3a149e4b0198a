// Linear regression that distrusts directions with few samples.
#pragma once

#include <Eigen/Core>

namespace fbs {

using RowMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct LinearMap {
  Eigen::MatrixXf weights;    ///< inputs x outputs
  Eigen::RowVectorXf offset;  ///< outputs
};

/// Least squares of inputs * weights + offset against the outputs, a sample a row, with squared weights
/// penalised.
/// @param ridge  the penalty, in mean variances of an input
[[nodiscard]] LinearMap fit_ridge(const RowMatrix& inputs, const RowMatrix& outputs, float ridge);

/// Logistic regression by Newton's method: log odds = inputs * weights + offset.
/// @param right  0 or 1 for each row of `inputs`
[[nodiscard]] LinearMap fit_logistic(const RowMatrix& inputs, const Eigen::VectorXf& right);

}  // namespace fbs
