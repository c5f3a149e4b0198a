// Fits the state to the viewer's picture: compares a pattern, drawn as the decoder draws it, with the picture
// at points spread over the mesh.
#pragma once

#include <span>
#include <vector>

#include "encoder/fit/comparison.h"
#include "encoder/fit/gauss_newton.h"
#include "encoder/fit/gaze_search.h"
#include "encoder/fit/lid_search.h"
#include "encoder/model/picture_cost.h"

namespace fbs {

/// Compares one pattern of a scene with one picture after another. Works at the work frame's size, whatever
/// the size of the picture.
class PictureFit {
 public:
  /// @param pattern  its work frame is cut like those of the later pictures
  /// The control points of setup.parts may move.
  PictureFit(const Setup& setup, const Geometry& geometry, const SeenPattern& pattern);

  /// Sets the picture for the next calls; shares its luma.
  /// @param levels  as of the pattern: one is enough for the cost alone
  void set_picture(const WorkFrame& picture, int levels = kFitLevels) {
    comparison_.picture = LumaPyramid(picture, levels);
  }

  /// Sets the decoder's colours inside the mouth, where more is known of them than setup.mouth.
  void set_mouth(const MouthInterior& mouth) { comparison_.mouth = mouth; }

  /// Replaces the pattern; compared at the same points.
  void set_pattern(const SeenPattern& pattern);

  /// `start` with upper lids and pupils found anew: LidSearch::best(), GazeSearch::best().
  [[nodiscard]] Fit with_best_eyes(const Fit& start) const;

  /// `start` refined against the picture: gauss_newton().
  [[nodiscard]] Fit refine(const Fit& start) const { return gauss_newton(comparison_, start); }
  /// The same of several starts: coarse_fit() of each, which may run at the same time, then fine_fit().
  [[nodiscard]] CoarseFit coarse(const FitStart& start) const { return coarse_fit(comparison_, start); }
  [[nodiscard]] BestFit fine(std::span<const CoarseFit> starts) const {
    return fine_fit(comparison_, starts);
  }

  /// The tracked contours and, where the inner lips have strayed from where the outer ones carry them, a
  /// second start with them there: a mouth that opens suddenly leaves their contour behind.
  [[nodiscard]] static std::vector<FitStart> starts_of(const Fit& tracked);

  /// Cost of this pattern in states near a fit.
  [[nodiscard]] PictureCost cost_at(const Fit& fit) const;

  /// The cost about the fit that one step of the descent from `start` leads to, with the constant taken at
  /// the start: replaces refine() and cost_at() for near starts, in a sixth of the time. About `start` itself
  /// when the step changes a number of the light by more than kMaxLightStep.
  [[nodiscard]] PictureCost cost_near(const Fit& start) const;

 private:
  /// @param picture  the picture's part of the normal equations
  [[nodiscard]] PictureCost cost_of(const Fit& fit, double constant, NormalEquations& picture) const;

  Comparison comparison_;
  LidSearch lids_;
  GazeSearch gaze_;
};

}  // namespace fbs
