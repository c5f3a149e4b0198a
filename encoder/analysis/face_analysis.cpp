#include "encoder/analysis/face_analysis.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "decoder/head/head_deformation.h"
#include "encoder/fit/fit_tuning.h"
#include "encoder/image/planes.h"
#include "encoder/model/skinning.h"

namespace fbs {
namespace {

/// Starts of a fit that are usually tried: more threads would be idle.
constexpr int kMostStarts = 3;

WorkFrame first_frame(const AnalysisStart& start, const Picture& picture, bool with_colour) {
  return WorkFrame::cut(picture, start.centre, start.eye_distance_px, with_colour);
}

}  // namespace

FaceAnalysis::FaceAnalysis(const EncoderSettings& settings, const FaceFinder& finder,
                           const AnalysisStart& start)
    : FaceAnalysis(settings, finder, start, first_frame(start, start.first, true)) {}

FaceAnalysis::FaceAnalysis(const EncoderSettings& settings, const FaceFinder& finder,
                           const AnalysisStart& start, const WorkFrame& first)
    : track_only_(settings.track_only),
      contours_(settings.expression && settings.contours),
      geometry_(start.geometry),
      // A live scene ends soon: patterns of another framing are worth one of their own, a place to join.
      head_(finder, start.geometry, pose_of(start.seen), first, start.eye_distance_px, !settings.live),
      features_(start.geometry, pose_of(start.seen), first, settings.descent),
      landmarks_(settings.landmark_search && !settings.track_only ? &finder.landmarks() : nullptr,
                 start.geometry, pose_of(start.seen), view(start.first.y)),
      fit_(start.setup, start.geometry, {first_frame(start, start.pattern, false), start.seen}),
      workers_(std::min(start.threads, kMostStarts), start.hooks) {
  now_.pose = pose_of(start.seen);
  report_.face = report_.followed = true;
  report_.geometry = start.geometry;
}

FaceAnalysis::Observation FaceAnalysis::observe(const Picture& picture) {
  Observation seen;
  seen.cost = std::exchange(begun_, true) ? fit_next(picture) : fit_first(picture);
  landmarks_.end_picture(report_.followed ? &now_ : nullptr);
  seen.state = state_of(now_);
  seen.face = report_.followed;
  seen.pose = now_.pose;
  seen.eye_distance_px = head_.eye_distance_px();
  seen.in_shot = head_.is_in_shot();
  seen.vertices = project_vertices(geometry_, seen.state);
  write_report(seen);
  return seen;
}

PictureCost FaceAnalysis::fit_first(const Picture& picture) {
  fit_.set_picture(head_.frame(picture, now_.pose.shift, false));
  return fit_.cost_at(now_);
}

PictureCost FaceAnalysis::fit_next(const Picture& picture) {
  report_.had_landmarks = report_.from_landmarks = false;
  const auto head = head_.follow(picture, now_.pose, skinned(geometry_, now_.offsets));
  report_.followed = head.has_value();
  if (!head) {
    now_ = relaxed();
    return cost_unseen(now_);
  }
  const Fit start = tracked(*head);
  fit_.set_picture(head->frame);
  now_ = track_only_ ? start : refined(picture, fit_.with_best_eyes(start));
  return fit_.cost_at(now_);
}

Fit FaceAnalysis::relaxed() {
  constexpr double kRemains = 0.85;  // of the expression, per picture: at rest after half a second
  Fit fit = now_;
  for (glm::dvec2& o : fit.offsets) o *= kRemains;
  features_.set_offsets(fit.offsets);
  return fit;
}

Fit FaceAnalysis::tracked(const HeadFollow::Found& head) {
  Fit fit{head.pose, now_.light, now_.interior, now_.offsets};
  if (!contours_) return fit;
  features_.track(head.frame, fit.pose, head_.tracker().flow());
  fit.offsets = features_.offsets();
  // Pupils have no contour: the fit to the picture moves them.
  for (const FeatureId id : {FeatureId::kPupilRight, FeatureId::kPupilLeft}) {
    const std::size_t c = feature(id).first_control;
    fit.offsets[c] = now_.offsets[c];
  }
  return fit;
}

Fit FaceAnalysis::refined(const Picture& picture, const Fit& tracked) {
  const std::vector<FitStart> contours = PictureFit::starts_of(tracked);
  const auto given = landmarks_.by_given(tracked.pose);
  constexpr std::size_t kGiven = 1, kContours = 2;  // behind the search, which takes longest
  std::vector<CoarseFit> starts(kContours + contours.size());
  const auto start_from = [&](const std::optional<Offsets>& seen) {
    if (!seen) return CoarseFit{};
    FitStart start{tracked, kLandmarkLips, kLandmarkCounts};
    std::copy_n(seen->begin(), feature(FeatureId::kPupilRight).first_control, start.fit.offsets.begin());
    return fit_.coarse(start);
  };
  workers_.run(static_cast<int>(starts.size()), [&](std::size_t k, int) {
    if (k >= kContours)
      starts[k] = fit_.coarse(contours[k - kContours]);
    else if (k == kGiven)
      starts[k] = start_from(given);
    else
      starts[k] = start_from(landmarks_.find(view(picture.y), tracked.pose, tracked.offsets));
  });
  const BestFit best = fit_.fine(starts);
  report_.had_landmarks = given.has_value();
  report_.from_landmarks = best.start == kGiven;
  if (best.start >= kContours) return best.fit;
  // Lids have no memory to correct: a blink is searched in each picture.
  Offsets followed = features_.offsets();
  std::copy_n(best.fit.offsets.begin(), feature(FeatureId::kUpperLidRight).first_control, followed.begin());
  features_.set_offsets(followed);
  return best.fit;
}

void FaceAnalysis::write_report(const Observation& seen) {
  report_.confidence = head_.confidence();
  report_.state = seen.state;
  for (std::size_t v = 0; v < kVertexCount; ++v)
    report_.vertices[v] = glm::dvec2(seen.vertices[v].x, seen.vertices[v].y) / kStateUnitsPerPixel;
  const PoseProjection projection(head_.tracker().pose());
  report_.snakes.clear();
  for (std::size_t i = 0; i < features_.count(); ++i) {
    SnakeOutline outline{{}, features_.is_closed(i), features_.iterations(i)};
    for (const glm::dvec3& p : features_.outline(i)) outline.points.push_back(projection(p));
    report_.snakes.push_back(std::move(outline));
  }
}

}  // namespace fbs
