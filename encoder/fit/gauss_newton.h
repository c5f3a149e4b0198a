// The fit's descent.
#pragma once

#include <limits>
#include <span>

#include "encoder/fit/comparison.h"
#include "encoder/fit/fit_priors.h"

namespace fbs {

struct BestFit {
  Fit fit;
  std::size_t start;  ///< index of the start it came from
};

/// A start taken through the coarse levels; by default one that is never chosen.
struct CoarseFit {
  FitStart start;
  Fit fit;
  double difference = std::numeric_limits<double>::infinity();  ///< mean_difference(), by FitStart::counts
};

/// Minimises the robust squared difference over pose, light, mouth interior and control points together:
/// Gauss-Newton with additive updates, coarse to fine, held near its start where the picture says nothing and
/// near rest everywhere (fit_priors.h).
[[nodiscard]] CoarseFit coarse_fit(const Comparison& comparison, const FitStart& start);
/// The fine level. Of several starts, only the one nearest to the picture continues; the first of equals.
/// @param starts  at least one
/// @return the start where nothing is gained
[[nodiscard]] BestFit fine_fit(const Comparison& comparison, std::span<const CoarseFit> starts);

[[nodiscard]] inline Fit gauss_newton(const Comparison& comparison, const Fit& start) {
  const CoarseFit lone = coarse_fit(comparison, {start});
  return fine_fit(comparison, {&lone, 1}).fit;
}

/// The result of one step on the fine level, and the equations it solved.
struct GaussNewtonStep {
  Fit fit;                  ///< the start when the equations cannot be solved
  double difference;        ///< add_picture() at the start
  NormalEquations picture;  ///< at the start, without the priors
};
[[nodiscard]] GaussNewtonStep gauss_newton_step(const Comparison& comparison, const Fit& start);

}  // namespace fbs
