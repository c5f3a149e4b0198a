// The kinds of features that snakes follow, and the tuned constants of each. Lengths in snake units.
#pragma once

#include "common/generic_head.h"
#include "encoder/track/snake/b_snake.h"

namespace fbs {

/// Snake units are 1/32 of the eye distance, so that the paper's delta_0 = 1 and sigma = 0.75 reach an eighth
/// of it.
inline constexpr double kSnakeUnitsPerEyeDistance = 32;
inline constexpr double kHeadUnitsPerSnakeUnit = kUnitsPerEyeDistance / kSnakeUnitsPerEyeDistance;

/// How a kind of feature is followed.
struct SnakeKind {
  SnakeWeights weights;
  int points;                  ///< p + 1 of the curve
  double blur;                 ///< sigma of the feature map's smoothing
  double above, below, aside;  ///< of the patch beyond the feature at rest
};

/// @param id  of a feature that a snake follows: neither a lower lid nor a pupil (assert)
[[nodiscard]] const SnakeKind& kind_of(FeatureId id);

[[nodiscard]] constexpr bool is_brow(FeatureId id) {
  return id == FeatureId::kBrowRight || id == FeatureId::kBrowLeft;
}
[[nodiscard]] constexpr bool is_upper_lid(FeatureId id) {
  return id == FeatureId::kUpperLidRight || id == FeatureId::kUpperLidLeft;
}

// Repulsion between facing points: the gap below which it acts, as a share of that at rest.
inline constexpr double kMinLipGap = 0.8, kMinMouthWidth = 0.7, kMinBrowLength = 0.97;
/// Both lips together; a mouth that is open in the first picture may close to them.
inline constexpr double kThickLips = 11;

/// What a shut lid's middle keeps from the lower lid: the line of lashes, which the snake sees. Not
/// PictureFit's kLidsApart (encoder/fit; eye distances): drawn without any eye left between, its lids pass
/// each other by 0.01. Making them one would move streams.
inline constexpr double kLidsApart = 0.45;

/// iBUG marks a brow's upper border; the middle, which the snake follows, lies this far below. About
/// kBrowHalfWidth of find/find_tuning.h (0.056 eye distances).
inline constexpr double kBrowBelowMarks = 1.8;

}  // namespace fbs
