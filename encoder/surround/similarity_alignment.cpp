#include "encoder/surround/similarity_alignment.h"

#include "encoder/image/robust.h"
#include "encoder/surround/surround_tuning.h"

namespace fbs {

using namespace surround;

namespace {
constexpr double kSquaredOutlier = kOutlierSigma * kOutlierSigma;
}

struct SimilarityAlignment::NormalEquations {
  cv::Matx44d left = cv::Matx44d::zeros();  ///< upper triangle
  cv::Vec4d right{0, 0, 0, 0};

  bool solve(cv::Vec4d& step) {
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < i; ++j) left(i, j) = left(j, i);
    return cv::solve(left, right, step, cv::DECOMP_CHOLESKY);
  }
};

glm::dvec2 SimilarityAlignment::moved(const Keypoint& keypoint, const Similarity& similarity) const {
  return keypoint.at + displacement(similarity, keypoint.from_head) / static_cast<double>(factor_);
}

void SimilarityAlignment::add_prior(const Similarity& now, const Similarity& prior,
                                    NormalEquations& normal) const {
  const double shift = kDisplacementSigma * eye_px_, scale = kScaleSigma * eye_px_;
  const Similarity sigma = {shift, shift, scale, scale};
  for (int i = 0; i < kSimilarityCount; ++i) {
    normal.left(i, i) = 1 / (sigma[i] * sigma[i]);
    normal.right(i) = (prior[i] - now[i]) * normal.left(i, i);
  }
}

void SimilarityAlignment::add_keypoints(Layer layer, int level, const Similarity& now,
                                        NormalEquations& normal) const {
  const double slope_unit = 1 / level_scale(level) / factor_;  // picture pixels to pixels of the level
  for (const Keypoint& keypoint : keypoints_) {
    const double mine = keypoint.layers.weight(layer);
    if (mine < kMinWeight) continue;
    const glm::dvec2 at = on_level(moved(keypoint, now), level);
    if (!has_cell(now_[level], at)) continue;
    const Sample& seen = keypoint.seen[level];
    const double r = bilinear<std::uint8_t>(now_[level], BilinearCell(at)) - static_cast<double>(seen.value);
    const double w = mine * geman_mcclure_weight(r * r / kSquaredOutlier) / (kResidualSigma * kResidualSigma);
    const double dx = static_cast<double>(seen.dx) * slope_unit,
                 dy = static_cast<double>(seen.dy) * slope_unit;
    const glm::dvec2 d = keypoint.from_head;
    const double by[4] = {dx, dy, dx * d.x + dy * d.y, dy * d.x - dx * d.y};
    for (int i = 0; i < 4; ++i) {
      normal.right(i) -= w * by[i] * r;
      for (int j = i; j < 4; ++j) normal.left(i, j) += w * by[i] * by[j];
    }
  }
}

Similarity SimilarityAlignment::align(Layer layer, const Similarity& start, const Similarity& prior) const {
  Similarity now = start;
  for (int level = kSurroundLevels - 1; level >= 0; --level) {
    for (int step = 0; step < kAlignmentSteps[level]; ++step) {
      NormalEquations normal;
      add_prior(now, prior, normal);
      add_keypoints(layer, level, now, normal);
      cv::Vec4d x;
      if (!normal.solve(x)) return start;
      for (int i = 0; i < kSimilarityCount; ++i) now[i] += x(i);
    }
  }
  return now;
}

double SimilarityAlignment::cost(Layer layer, const Similarity& similarity, bool rim_only) const {
  double sum = 0, weights = 0;
  for (const Keypoint& keypoint : keypoints_) {
    const double mine = keypoint.layers.weight(layer);
    if (mine < kMinWeight || (rim_only && !keypoint.on_rim())) continue;
    const glm::dvec2 at = moved(keypoint, similarity);
    if (!has_cell(now_[0], at)) continue;
    const double r =
        bilinear<std::uint8_t>(now_[0], BilinearCell(at)) - static_cast<double>(keypoint.seen[0].value);
    sum += mine * geman_mcclure(r * r, kSquaredOutlier);
    weights += mine;
  }
  return weights > 0 ? sum / weights : 0;
}

}  // namespace fbs
