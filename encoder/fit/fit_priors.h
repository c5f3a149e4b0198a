// Priors of a fit, before the picture is compared.
#pragma once

#include "encoder/fit/fit_columns.h"
#include "encoder/fit/normal_equations.h"

namespace fbs {

/// Adds priors: near the start, and an expression that faces make.
/// @param fit  point about which the equations are linearised
void add_priors(const FitColumns& columns, const Fit& start, const Fit& fit, NormalEquations& normal);

}  // namespace fbs
