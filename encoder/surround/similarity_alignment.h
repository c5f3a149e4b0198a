// Aligns keypoints of the first picture to a later one by a similarity.
#pragma once

#include <span>

#include "encoder/surround/keypoint.h"
#include "encoder/surround/similarity.h"

namespace fbs {

/// Gauss-Newton on the keypoints' luma, coarse to fine, with Geman-McClure weights for hidden or new content
/// and a Gaussian prior. Holds references: for one picture.
class SimilarityAlignment {
 public:
  /// @param now     the later picture
  /// @param factor  pixels of the picture per work pixel
  /// @param eye_px  eye distance in the first picture: unit of the prior
  SimilarityAlignment(std::span<const Keypoint> keypoints, const SurroundPyramid& now, int factor,
                      double eye_px)
      : keypoints_(keypoints), now_(now), factor_(factor), eye_px_(eye_px) {}

  /// @param prior  mean of the prior
  /// @return `start` when the keypoints do not determine a similarity
  [[nodiscard]] Similarity align(Layer layer, const Similarity& start, const Similarity& prior) const;

  /// Mean of the robust squared difference over a layer's keypoints, by their weight; 0 without any.
  /// @param rim_only  only keypoints near the picture's sides and top
  [[nodiscard]] double cost(Layer layer, const Similarity& similarity, bool rim_only = false) const;

 private:
  struct NormalEquations;
  [[nodiscard]] glm::dvec2 moved(const Keypoint& keypoint, const Similarity& similarity) const;
  void add_prior(const Similarity& now, const Similarity& prior, NormalEquations& normal) const;
  void add_keypoints(Layer layer, int level, const Similarity& now, NormalEquations& normal) const;

  std::span<const Keypoint> keypoints_;
  const SurroundPyramid& now_;
  int factor_;
  double eye_px_;
};

}  // namespace fbs
