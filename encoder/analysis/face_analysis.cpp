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
      expression_(settings.expression),
      contours_(settings.contours),
      eye_distance_px_(start.eye_distance_px),
      geometry_(start.geometry),
      mouth_(start.setup.mouth),
      head_(start.geometry, pose_of(start.seen), first),
      search_(finder),
      features_(start.geometry, pose_of(start.seen), first, settings.descent),
      given_expression_(start.geometry),
      fit_(start.setup, start.geometry, {first_frame(start, start.pattern, false), start.seen}) {
  now_.pose = pose_of(start.seen);
  if (settings.landmark_search && !settings.track_only)
    landmarks_.emplace(finder.landmarks(), start.geometry, now_.pose, view(start.first.y));
  if (settings.surround) surround_.emplace(start.first, start.seen);
}

FaceAnalysis::Observation FaceAnalysis::observe(const Picture& picture) {
  Observation seen;
  seen.cost = begun_ ? fit_next(picture) : fit_first(picture);
  begun_ = true;
  // Calibrate where tracker and fit place the same face, the first time that both have it.
  if (given_ && face_shows_ && !given_expression_.is_calibrated())
    given_expression_.calibrate(*given_, now_.pose, now_.offsets);
  given_.reset();
  seen.state = state_of(now_);
  seen.face = face_shows_;
  if (surround_) {
    if (std::exchange(surround_begins_, false)) surround_.emplace(picture, seen.state);
    if (!elsewhere_) surround_->observe(picture, now_.pose);
    surround_->add_to(seen.cost);
    surround_->add_to(seen.state);
  }
  seen.vertices = project_vertices(geometry_, seen.state);
  write_report(seen);
  return seen;
}

void FaceAnalysis::set_surround_map(const SurroundMap& map) {
  if (surround_) surround_->set_map(map);
}

PictureCost FaceAnalysis::fit_first(const Picture& picture) {
  fit_.set_picture(WorkFrame::cut(picture, now_.pose.shift, eye_distance_px_, false), mouth_);
  report_.confidence = 1;
  return fit_.cost_at(now_);
}

bool FaceAnalysis::recognises(const Picture& picture) {
  const FaceSearch::Detection found =
      search_.find_anywhere(picture, head_, now_.pose, skinned(geometry_, now_.offsets));
  if (!found.accepted) return false;
  head_.restart(found.head.pose, WorkFrame::cut(picture, found.head.pose.shift, eye_distance_px_, true));
  search_.rest();
  elsewhere_ = false;
  return true;
}

PictureCost FaceAnalysis::fit_next(const Picture& picture) {
  report_.had_landmarks = report_.from_landmarks = false;
  if (elsewhere_) {
    face_shows_ = false;
    report_.confidence = 0;
    now_ = relaxed();
    return cost_unseen(now_);
  }
  const HeadVertices vertices = skinned(geometry_, now_.offsets);
  WorkFrame frame = WorkFrame::cut(picture, head_.pose().shift, eye_distance_px_, true);
  const std::optional<TrackedPose> head = follow_head(picture, vertices, frame);
  face_shows_ = head.has_value();
  if (!head) {
    now_ = relaxed();
    return cost_unseen(now_);
  }
  Fit start = tracked(frame, *head);
  fit_.set_picture(frame, mouth_);
  now_ = track_only_ ? start : refined(picture, fit_.with_best_eyes(start));
  return fit_.cost_at(now_);
}

std::optional<TrackedPose> FaceAnalysis::follow_head(const Picture& picture, const HeadVertices& vertices,
                                                     WorkFrame& frame) {
  const Pose last_good = now_.pose;
  // Flow between pictures without the head is meaningless: once lost, the head is searched.
  if (!search_.lost()) {
    const TrackedPose tracked = head_.track(frame, vertices);
    report_.confidence = tracked.confidence;
    if (tracked.confidence >= FaceSearch::kLostBelow) return tracked;
  }
  const FaceSearch::Detection found = search_.find(picture, head_, last_good, vertices);
  report_.confidence = found.head.confidence;
  if (!found.accepted) {
    head_.restart(last_good, frame);
    return std::nullopt;
  }
  search_.rest();
  frame = WorkFrame::cut(picture, found.head.pose.shift, eye_distance_px_, true);
  head_.restart(found.head.pose, frame);
  const TrackedPose tracked = head_.track(frame, vertices);
  report_.confidence = tracked.confidence;
  return tracked;
}

Fit FaceAnalysis::relaxed() {
  constexpr double kRemains = 0.85;  // of the expression, per picture: at rest after half a second
  Fit fit = now_;
  for (glm::dvec2& o : fit.offsets) o *= kRemains;
  features_.set_offsets(fit.offsets);
  return fit;
}

Fit FaceAnalysis::tracked(const WorkFrame& frame, const TrackedPose& head) {
  Fit fit{head.pose, now_.light, now_.interior, now_.offsets};
  if (!expression_ || !contours_) return fit;
  features_.track(frame, fit.pose, head_.flow());
  fit.offsets = features_.offsets();
  // Pupils have no contour: the fit to the picture moves them.
  for (const FeatureId id : {FeatureId::kPupilRight, FeatureId::kPupilLeft}) {
    const std::size_t c = feature(id).first_control;
    fit.offsets[c] = now_.offsets[c];
  }
  return fit;
}

Fit FaceAnalysis::refined(const Picture& picture, const Fit& tracked) {
  std::vector<FitStart> starts = PictureFit::starts_of(tracked);
  const std::size_t contours = starts.size();
  const auto start_from = [&](const Offsets& seen) {
    starts.push_back({tracked, kLandmarkStartCounts});
    std::copy_n(seen.begin(), feature(FeatureId::kPupilRight).first_control,
                starts.back().fit.offsets.begin());
  };
  if (landmarks_)
    if (const auto seen = landmarks_->find(view(picture.y), tracked.pose, tracked.offsets)) start_from(*seen);
  const std::size_t searched = starts.size();
  if (given_ && given_expression_.is_calibrated())
    start_from(given_expression_.offsets(*given_, tracked.pose));
  const BestFit best = fit_.refine(starts);
  report_.had_landmarks = starts.size() > searched;
  report_.from_landmarks = best.start >= searched;
  if (best.start < contours) return best.fit;
  // Lids have no memory to correct: a blink is searched in each picture.
  Offsets followed = features_.offsets();
  std::copy_n(best.fit.offsets.begin(), feature(FeatureId::kUpperLidRight).first_control, followed.begin());
  features_.set_offsets(followed);
  return best.fit;
}

void FaceAnalysis::write_report(const Observation& seen) {
  report_.face = true;
  report_.followed = face_shows_;
  report_.geometry = geometry_;
  report_.state = seen.state;
  for (std::size_t v = 0; v < kVertexCount; ++v)
    report_.vertices[v] = glm::dvec2(seen.vertices[v].x, seen.vertices[v].y) / kStateUnitsPerPixel;
  const PoseProjection projection(head_.pose());
  report_.snakes.clear();
  for (std::size_t i = 0; i < features_.count(); ++i) {
    SnakeOutline outline{{}, features_.is_closed(i), features_.iterations(i)};
    for (const glm::dvec3& p : features_.outline(i)) outline.points.push_back(projection(p));
    report_.snakes.push_back(std::move(outline));
  }
}

}  // namespace fbs
