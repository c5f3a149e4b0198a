#include "encoder/fit/gaze_search.h"

#include "encoder/fit/fit_tuning.h"

namespace fbs {
namespace {

constexpr std::array kPupils = {FeatureId::kPupilRight, FeatureId::kPupilLeft};

MovedPoints moved_by(const SamplePoints& points, FeatureId pupil) {
  return {points, feature(pupil).first_control, feature(pupil).control_count};
}

Fit looking(Fit fit, glm::dvec2 offset) {
  for (const FeatureId pupil : kPupils) fit.offsets[feature(pupil).first_control] = offset;
  return fit;
}

}  // namespace

GazeSearch::GazeSearch(const SamplePoints& points)
    : eyes_{moved_by(points, kPupils[0]), moved_by(points, kPupils[1])} {}

Fit GazeSearch::best(const Comparison& comparison, const Fit& start) const {
  if (!comparison.columns.has(feature(kPupils[0]).first_control)) return start;
  const auto difference = [&](const Fit& fit) {
    return eyes_[0].difference(comparison, fit) + eyes_[1].difference(comparison, fit);
  };
  Fit best = start;
  double least = difference(start) * kGazeKept;
  for (const double x : kGazes) {
    Fit fit = looking(start, {x * kMaxGazeX, 0});
    if (const double d = difference(fit); d < least) {
      least = d;
      best = fit;
    }
  }
  return best;
}

}  // namespace fbs
