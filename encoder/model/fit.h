// The state of a picture in continuous numbers, as the analysis estimates it.
#pragma once

#include <array>

#include "encoder/model/expression_basis.h"
#include "encoder/model/light_units.h"
#include "encoder/model/pose.h"

namespace fbs {

/// Pose, light and mouth interior (grey levels, else as in State), offsets of all control points (head
/// units).
struct Fit {
  Pose pose;
  std::array<double, kLightCount> light{};
  std::array<double, kInteriorCount> interior{};
  Offsets offsets{};
};

/// Numbers of a fit in the order in which PictureFit solves for them: pose (radians, pixels, log2), light,
/// mouth interior, offsets.
inline constexpr int kFitOffsets = kPoseCount + kLightCount + kInteriorCount;
inline constexpr int kFitNumbers = kFitOffsets + kCoefficientCount;

/// The state nearest to a fit; body and ground stay as pattern 0 saw them.
[[nodiscard]] State state_of(const Fit& fit);

/// The fit whose state is `state`, without body and ground.
[[nodiscard]] Fit fit_of(const State& state);

}  // namespace fbs
