// The kinds of features that snakes follow, and the tuned constants of each. Lengths in snake units.
#pragma once

#include "common/generic_head.h"
#include "encoder/track/snake/b_snake.h"

namespace fbs {

/// Snake units are 1/32 of the eye distance: the paper's delta_0 = 1 and sigma = 0.75 reach an eighth of it.
inline constexpr double kSnakeUnitsPerEyeDistance = 32;
inline constexpr double kHeadUnitsPerSnakeUnit = kUnitsPerEyeDistance / kSnakeUnitsPerEyeDistance;

/// How a kind of feature is tracked.
struct SnakeKind {
  SnakeWeights weights;
  int points;                  ///< p + 1 of the curve
  double blur;                 ///< sigma of the feature map's smoothing
  double above, below, aside;  ///< size of the patch beyond the feature at rest
};

[[nodiscard]] const SnakeKind& kind_of(FeatureId id);

[[nodiscard]] constexpr bool is_brow(FeatureId id) {
  return id == FeatureId::kBrowRight || id == FeatureId::kBrowLeft;
}
[[nodiscard]] constexpr bool is_upper_lid(FeatureId id) {
  return id == FeatureId::kUpperLidRight || id == FeatureId::kUpperLidLeft;
}

// Repulsion between facing points: the gap below which it acts, as a share of the gap at rest.
inline constexpr double kMinLipGap = 0.8, kMinMouthWidth = 0.7, kMinBrowLength = 0.97;
/// Thickness of both lips together; a mouth open in the first picture may close to it.
inline constexpr double kThickLips = 11;

/// Distance of a shut lid's middle from the lower lid: the line of lashes, which the snake sees. Not
/// kLidOverlap (encoder/fit; eye distances): there the lids, drawn without any eye between, pass each other
/// by 0.01. Making them one would change streams.
inline constexpr double kLidsApart = 0.45;

/// iBUG marks a brow's upper border; the middle, which the snake follows, lies this far below.
inline constexpr double kBrowBelowMarks = 1.8;

}  // namespace fbs
