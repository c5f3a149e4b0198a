// The fit's descent.
#pragma once

#include "encoder/fit/comparison.h"

namespace fbs {

/// Minimises the robust squared difference over pose, light, mouth interior and control points together:
/// Gauss-Newton with additive updates, coarse to fine, held near `start` where the picture says nothing and
/// near rest everywhere (fit_priors.h).
/// @return `start` where nothing is gained
[[nodiscard]] Fit gauss_newton(const Comparison& comparison, const Fit& start);

/// Where one step on the fine level leads, and what it was solved from.
struct GaussNewtonStep {
  Fit fit;                  ///< the start when the equations cannot be solved
  double difference;        ///< add_picture() at the start
  NormalEquations picture;  ///< at the start, without the priors
};
[[nodiscard]] GaussNewtonStep gauss_newton_step(const Comparison& comparison, const Fit& start);

}  // namespace fbs
