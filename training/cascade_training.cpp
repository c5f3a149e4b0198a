#include "training/cascade_training.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "encoder/landmarks/landmark_search.h"
#include "training/in_parallel.h"
#include "training/ridge.h"

namespace fbs {
namespace {

/// Coarse first. Two more coarse ones gain nothing (five-fold cross-validation over the stills).
constexpr Look kLooks[] = {{48, 2, 5}, {64, 2, 5}, {80, 2, 5}, {80, 1.5F, 4}, {96, 1.5F, 4}};

/// In mean variances of an input. 15 takes strangers' lips from 3.4 to 3.6 % (five-fold).
constexpr float kCascadeRidge = 5;

constexpr Eigen::Index kNumbers = 2 * kLandmarkCount;

/// Root-mean-square radius 1 about (0, 0).
Shape normalised(const Shape& shape) {
  const glm::vec2 middle = mean_of(shape);
  float squares = 0;
  for (const glm::vec2 p : shape)
    squares += (p.x - middle.x) * (p.x - middle.x) + (p.y - middle.y) * (p.y - middle.y);
  const float scale = 1 / std::sqrt(squares / kLandmarkCount);
  return PlaneSimilarity{scale, {-middle.x * scale, -middle.y * scale}}(shape);
}

/// Procrustes: the mean of all shapes turned and scaled to it.
Shape mean_shape(const std::vector<PatchSample>& samples) {
  constexpr int kRounds = 4;
  Shape mean = normalised(samples.front().truth);
  for (int i = 0; i < kRounds; ++i) {
    Shape sum{};
    for (const PatchSample& s : samples) {
      const Shape upright = PlaneSimilarity::between(s.truth, mean)(s.truth);
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += upright[k];
    }
    mean = normalised(sum);
  }
  return mean;
}

/// The remaining distance to the truth, in units of the mean shape.
Eigen::RowVectorXf missing(const Shape& shape, const Shape& truth, const Shape& mean) {
  const PlaneSimilarity to_mean = PlaneSimilarity::between(shape, mean);
  Eigen::RowVectorXf out(kNumbers);
  for (std::size_t k = 0; k < shape.size(); ++k) {
    const glm::vec2 d = to_mean(truth[k]) - to_mean(shape[k]);
    out(static_cast<Eigen::Index>(2 * k)) = d.x;
    out(static_cast<Eigen::Index>(2 * k + 1)) = d.y;
  }
  return out;
}

std::vector<float> to_vector(const RowMatrix& m) {
  return {m.data(), m.data() + m.size()};
}

LandmarkStage train_stage(const Look& look, const Shape& mean, const std::vector<PatchSample>& samples,
                          const std::vector<Shape>& shapes) {
  const auto count = static_cast<Eigen::Index>(shapes.size());
  RowMatrix descriptors(count, kDescriptorSize), moves(count, kNumbers);
  in_parallel(shapes.size(), [&](std::size_t i) {
    const PatchSample& sample = samples[i];
    const auto row = static_cast<Eigen::Index>(i);
    UprightView(sample.patch, shapes[i], mean, look)
        .describe(shapes[i], {descriptors.row(row).data(), kDescriptorSize});
    moves.row(row) = missing(shapes[i], sample.truth, mean);
  });
  const Eigen::RowVectorXf mean_move = moves.colwise().mean();
  const RowMatrix centred = moves.rowwise() - mean_move;
  const Eigen::MatrixXf covariance = centred.transpose() * centred;
  const Eigen::JacobiSVD<Eigen::MatrixXf> svd(covariance, Eigen::ComputeThinU);
  const RowMatrix modes = svd.matrixU().leftCols(kShapeModes).transpose();
  const LinearMap map = fit_ridge(descriptors, centred * modes.transpose(), kCascadeRidge);
  LandmarkStage stage{look, quantised(map.weights), to_vector(modes), {}};
  stage.offset = to_vector(mean_move + map.offset * modes);
  return stage;
}

}  // namespace

DescriptorMap quantised(const Eigen::MatrixXf& weights) {
  DescriptorMap out;
  out.outputs = static_cast<int>(weights.cols());
  const Eigen::RowVectorXf largest = weights.cwiseAbs().colwise().maxCoeff() / 127;
  out.scale.assign(largest.data(), largest.data() + largest.size());
  for (Eigen::Index row = 0; row < weights.rows(); ++row)
    for (Eigen::Index column = 0; column < weights.cols(); ++column)
      out.weights.push_back(static_cast<std::int8_t>(std::lround(weights(row, column) / largest(column))));
  return out;
}

LandmarkTable train_cascade(const std::vector<PatchSample>& samples) {
  LandmarkTable table;
  table.mean = mean_shape(samples);
  // The samples' places err as much as detectors do, so the usual shape is the start.
  std::vector<Shape> shapes(samples.size(), LandmarkSearch::usual_shape(table.mean));
  for (const Look& look : kLooks) {
    table.stages.push_back(train_stage(look, table.mean, samples, shapes));
    in_parallel(shapes.size(), [&](std::size_t i) {
      const UprightView view(samples[i].patch, shapes[i], table.mean, look);
      shapes[i] = LandmarkSearch::moved(table.stages.back(), table.mean, view, shapes[i]);
    });
  }
  return table;
}

}  // namespace fbs
