// A pattern, a picture and the points at which they are compared: the input of the whole fit.
#pragma once

#include "encoder/fit/appearance.h"
#include "encoder/fit/fit_columns.h"
#include "encoder/fit/luma_pyramid.h"
#include "encoder/fit/normal_equations.h"
#include "encoder/fit/pattern_samples.h"
#include "encoder/fit/sample_points.h"

namespace fbs {

struct Comparison {
  Geometry geometry;
  FitColumns columns;
  SamplePoints points;
  PatternSamples pattern;
  LumaPyramid picture{};
  MouthInterior mouth{};

  /// Spreads points over the head as seen in the pattern; no picture yet. The control points of setup.parts
  /// may move.
  [[nodiscard]] static Comparison with(const Setup& setup, const Geometry& geometry,
                                       const SeenPattern& pattern);

  /// The decoder's picture of a fit. Borrows this.
  /// @param vertices  skinned by the fit
  [[nodiscard]] Appearance appearance(const Fit& fit, const HeadVertices& vertices) const {
    return {points, pattern, mouth, fit, vertices};
  }
};

/// Squared, and linear from kHuberLevels on.
[[nodiscard]] double huber(double difference);

/// Robust mean of squared differences on the fine level, each point counted once; zero when no point is seen.
[[nodiscard]] double mean_difference(const Comparison& comparison, const Fit& fit);

/// Adds the picture's part of a Gauss-Newton step: robustly weighted luma differences at every point, over
/// kResidualSigma. All points count alike, even on triangles that face away: leaving those out gained 0.06 dB
/// in the face on the mean of ten clips at three qualities, and lost 0.35 dB on foreman_cif at one.
/// @return robust sum of squared differences over the samples of the full picture that the points represent
double add_picture(const Comparison& comparison, int level, const Fit& fit, NormalEquations& normal);

}  // namespace fbs
