// Fits the state to what the viewer will see: a pattern drawn as the decoder draws it against the picture, at
// points spread over the mesh. Design section 6.
#pragma once

#include <span>
#include <vector>

#include "encoder/fit/comparison.h"
#include "encoder/fit/gauss_newton.h"
#include "encoder/fit/gaze_search.h"
#include "encoder/fit/lid_search.h"
#include "encoder/model/picture_cost.h"

namespace fbs {

/// One pattern of a scene against one picture after another. Works at the work frame's size, whatever the
/// size of the picture.
class PictureFit {
 public:
  /// @param pattern  its work frame is cut like those of the later pictures
  /// The control points of setup.parts may move.
  PictureFit(const Setup& setup, const Geometry& geometry, const SeenPattern& pattern);

  /// The picture that the next calls are about; its luma is shared.
  /// @param mouth  colours that the decoder shows inside the mouth, as far as is known
  void set_picture(const WorkFrame& picture, const MouthInterior& mouth);

  /// Another pattern than the constructor's, compared at the same points.
  void set_pattern(const SeenPattern& pattern);

  /// `start` with upper lids and pupils found anew: LidSearch::best(), GazeSearch::best().
  [[nodiscard]] Fit with_best_eyes(const Fit& start) const;

  /// `start` refined against the picture: gauss_newton().
  [[nodiscard]] Fit refine(const Fit& start) const { return gauss_newton(comparison_, start); }
  [[nodiscard]] BestFit refine(std::span<const FitStart> starts) const {
    return gauss_newton(comparison_, starts);
  }

  /// The contours as tracked and, where the inner lips have strayed from where the outer ones carry them,
  /// from there, too: a mouth that opens at once leaves their contour behind.
  [[nodiscard]] static std::vector<FitStart> starts_of(const Fit& tracked);

  /// What this pattern costs in states near a fit.
  [[nodiscard]] PictureCost cost_at(const Fit& fit) const;

  /// The same about the fit that one step of the descent from `start` leads to, but for the constant, which
  /// is that at the start: for starts so near that this takes the place of refine() and cost_at(), in a sixth
  /// of the time. About `start` itself when the step changes a number of the light by more than
  /// kMaxLightStep.
  [[nodiscard]] PictureCost cost_near(const Fit& start) const;

 private:
  /// @param picture  its part of the normal equations
  [[nodiscard]] PictureCost cost_of(const Fit& fit, double constant, NormalEquations& picture) const;

  Comparison comparison_;
  LidSearch lids_;
  GazeSearch gaze_;
};

}  // namespace fbs
