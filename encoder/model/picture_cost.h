// Cost in a picture of states other than the fitted one: the planner weighs it against bits.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "encoder/model/fit.h"

namespace fbs {

/// A part of the picture that is drawn from one pattern.
enum class CostLayer : std::uint8_t { kHead, kSurround };

/// Robust squared luma difference over a layer, in samples of the full picture, when it is drawn from
/// `pattern` in a state x near the picture's fit:  constant + (x - fit)^T quadratic (x - fit).
struct LayerCost {
  CostLayer layer = CostLayer::kHead;
  int pattern = 0;
  double constant = 0;  ///< at the fit itself: the pattern's remaining error, whatever the state
  cv::Mat1d quadratic;  ///< kParameterCount x kParameterCount; zero for numbers that do not move the layer
};

/// One picture, whose cost is the sum over the layers.
struct PictureCost {
  std::array<double, kParameterCount>
      fit{};  ///< numbers of the coded state, in units of State and head units
  std::vector<LayerCost> layers;

  /// Sum of the layers' quadratics.
  [[nodiscard]] cv::Mat1d quadratic() const;
  [[nodiscard]] double constant() const;
};

/// Cost of a picture without a fit (the face is lost): only the pose is held a little.
[[nodiscard]] PictureCost cost_unseen(const Fit& fit);

/// Cost of the head, drawn from a pattern.
/// @param constant  at the fit
/// @param own  kFitNumbers x kFitNumbers, symmetric: the quadratic over the fit's own numbers
[[nodiscard]] PictureCost cost_of(const Fit& fit, int pattern, double constant, const cv::Mat1d& own);

}  // namespace fbs
