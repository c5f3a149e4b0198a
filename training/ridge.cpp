#include "training/ridge.h"

#include <Eigen/Cholesky>

namespace fbs {

LinearMap fit_ridge(const RowMatrix& inputs, const RowMatrix& outputs, float ridge) {
  const Eigen::RowVectorXf input_mean = inputs.colwise().mean(), output_mean = outputs.colwise().mean();
  const RowMatrix x = inputs.rowwise() - input_mean;
  Eigen::MatrixXf normal = Eigen::MatrixXf::Zero(x.cols(), x.cols());
  normal.selfadjointView<Eigen::Lower>().rankUpdate(x.transpose());
  normal.diagonal().array() += ridge * normal.diagonal().mean();
  LinearMap out;
  out.weights =
      normal.selfadjointView<Eigen::Lower>().llt().solve(x.transpose() * (outputs.rowwise() - output_mean));
  out.offset = output_mean - input_mean * out.weights;
  return out;
}

LinearMap fit_logistic(const RowMatrix& inputs, const Eigen::VectorXf& right) {
  constexpr int kSteps = 30;
  constexpr double kPenalty = 1e-3;  // in samples: keeps weights finite where a plane separates all of them
  const Eigen::Index n = inputs.cols();
  Eigen::MatrixXd x(inputs.rows(), n + 1);
  x << inputs.cast<double>(), Eigen::VectorXd::Ones(inputs.rows());
  Eigen::VectorXd w = Eigen::VectorXd::Zero(n + 1);
  for (int i = 0; i < kSteps; ++i) {
    const Eigen::ArrayXd p = 1 / (1 + (-(x * w).array()).exp());
    Eigen::MatrixXd hessian = x.transpose() * (p * (1 - p)).matrix().asDiagonal() * x;
    hessian.diagonal().array() += kPenalty * static_cast<double>(x.rows());
    const Eigen::VectorXd gradient = x.transpose() * (right.cast<double>().array() - p).matrix() -
                                     kPenalty * static_cast<double>(x.rows()) * w;
    w += hessian.ldlt().solve(gradient);
  }
  return {w.head(n).cast<float>(), Eigen::RowVectorXf::Constant(1, static_cast<float>(w(n)))};
}

}  // namespace fbs
