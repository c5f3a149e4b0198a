// The fit's descent.
#pragma once

#include "encoder/fit/comparison.h"

namespace fbs {

/// Minimises the robust squared difference over pose, light, mouth interior and control points together:
/// Gauss-Newton with additive updates, coarse to fine, held near `start` where the picture says nothing and
/// near rest everywhere (fit_priors.h).
/// @return `start` where nothing is gained
[[nodiscard]] Fit gauss_newton(const Comparison& comparison, const Fit& start);

/// A step of the descent on the fine level from `start`: unknowns in the order of comparison.columns.
/// @param picture  receives the picture's part of the equations
/// @return nothing when they cannot be solved
struct SingleStep {
  Fit fit;
  double difference;         ///< add_picture() at the start
  NormalEquations picture;  ///< without the priors
};
[[nodiscard]] SingleStep gauss_newton_step(const Comparison& comparison, const Fit& start);

}  // namespace fbs
