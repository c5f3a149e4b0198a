// Priors of a fit, before the picture is compared.
#pragma once

#include "encoder/fit/fit_columns.h"
#include "encoder/fit/normal_equations.h"

namespace fbs {

/// Where a fit begins.
struct FitStart {
  Fit fit;
  double lips = 1;    ///< factor on the sigmas of the lips about it
  double counts = 1;  ///< factor on its difference from the picture when starts are compared
};

/// Adds priors: near the start, and an expression that faces make.
/// @param fit  point about which the equations are linearised
void add_priors(const FitColumns& columns, const FitStart& start, const Fit& fit, NormalEquations& normal);

}  // namespace fbs
