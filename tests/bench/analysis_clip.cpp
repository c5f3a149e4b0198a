#include "tests/bench/analysis_clip.h"

#include <cmath>

#include "encoder/plan/operating_point.h"

namespace fbs {

AnalysisClip::AnalysisClip()
    : clip_(talker_settings(352, 288, kPictures)),
      head_(*adapt_head(clip_.marks(0))),
      first_(WorkFrame::cut(clip_[0], head_.pose.shift, eye_distance_px(), true)) {
  for (std::size_t v = 0; v < kVertexCount; ++v) neutral_[v] = glm::dvec3(head_.geometry.positions[v]);
  const OperatingPoint point = OperatingPoint::at(50, eye_distance_px());
  setup_.format = clip_.format();
  setup_.steps = point.steps;
  lambda_ = point.lambda;
  const auto numbers = numbers_of(head_.pose);
  for (std::size_t i = 0; i < kPoseCount; ++i)
    seen_coded_[i] = static_cast<std::int32_t>(std::lround(numbers[i] / step_of(setup_.steps, i)));
  seen_ = state_of(seen_coded_, setup_.steps);

  HeadTracker head(head_.geometry, head_.pose, first_);
  FeatureTracker features(head_.geometry, head_.pose, first_);
  PictureFit fit(setup_, head_.geometry, {first_, seen_});
  Fit now{pose_of(seen_), {}, {}};
  // Twice round, so that the first picture too comes from its neighbour.
  constexpr int kRound = 2 * (kPictures - 1);
  round_.resize(kRound);
  for (int i = 1; i <= 2 * kRound; ++i) {
    const int phase = i % kRound;
    AnalysedPicture& p = round_[phase];
    p.picture = clip_[phase < kPictures ? phase : kRound - phase];
    p.frame = WorkFrame::cut(p.picture, head.pose().shift, eye_distance_px(), true);
    p.tracked = head.track(p.frame, neutral_);
    p.flow = head.flow();
    features.track(p.frame, p.tracked.pose, p.flow);
    p.tracked_fit = {p.tracked.pose, now.light, now.interior, features.offsets()};
    fit.set_picture(p.frame);
    now = fit.refine(p.tracked_fit);
    p.cost = fit.cost_at(now);
  }
}

AnalysisClip& analysis_clip() {
  static AnalysisClip clip;
  return clip;
}

}  // namespace fbs
