#include "tests/figures/edited_state.h"

#include <cmath>
#include <opencv2/core.hpp>

#include "common/ibug.h"
#include "encoder/model/expression_prior.h"
#include "encoder/model/skinning.h"

namespace fbs::figures {
namespace {

/// A number that is linear in the offsets of lips and brows, such as the height of the mouth, by its weight
/// for each of them (2 * control point + axis).
using Functional = cv::Mat1d;

Functional nothing() {
  return cv::Mat1d::zeros(static_cast<int>(2 * kExpressionControls), 1);
}

/// `state` moved along the most probable expression in which the functional has a value, eye distances:
/// C a v / (a' C a), with C the covariance of expressions.
State moved_along(State state, const Functional& a, double value) {
  cv::Mat1d along;  // C a
  cv::solve(expression_precision(), a, along, cv::DECOMP_CHOLESKY);
  along *= value * kUnitsPerEyeDistance / a.dot(along);
  for (int c = 0; c < static_cast<int>(kExpressionControls); ++c)
    for (int axis = 0; axis < 2; ++axis)
      state.control[static_cast<std::size_t>(c)][axis] +=
          static_cast<std::int32_t>(std::lround(along(2 * c + axis)));
  return state;
}

/// Adds a vertex's position along y, this many times.
void add_height(std::size_t landmark, double times, Functional& a) {
  for (const SkinningWeight& skinning : skinning_of(vertex_of_landmark(landmark)))
    if (skinning.control < kExpressionControls)
      a(2 * skinning.control + 1) += times * skinning.weight / kSkinningOne;
}

}  // namespace

State turned(State state, double yaw_deg, double pitch_deg) {
  const auto units = [](double degrees) {
    return static_cast<std::int32_t>(std::lround(degrees * 65536 / 360));
  };
  state.pose[kYaw] += units(yaw_deg);
  state.pose[kPitch] += units(pitch_deg);
  return state;
}

State with_brows_raised(State state, double height) {
  Functional up = nothing();
  const int first = feature(FeatureId::kBrowRight).first_control,
            end = feature(FeatureId::kUpperLidRight).first_control;
  for (int c = first; c < end; ++c) up(2 * c + 1) = -1.0 / (end - first);
  return moved_along(state, up, height);
}

State with_mouth_open(State state, double height) {
  Functional gap = nothing();
  add_height(ibug::kLowerLipInner, 1, gap);
  add_height(ibug::kUpperLipInner, -1, gap);
  return moved_along(state, gap, height);
}

}  // namespace fbs::figures
