#include "encoder/track/head_tracker.h"

#include "encoder/model/skinning.h"
#include "encoder/track/head/head_tuning.h"
#include "encoder/track/head/pose_alignment.h"

namespace fbs {

HeadTracker::HeadTracker(const Geometry& geometry, const Pose& pose, const WorkFrame& first)
    : appearance_(skinned(geometry, {}), pose, first), pose_(pose), before_(first) {}

TrackedPose HeadTracker::track(const WorkFrame& now, const HeadVertices& vertices) {
  flow_ = mesh_flow(before_, now, pose_, vertices);
  const LevelledFrame levelled(now);
  const std::vector<glm::dvec3> points = appearance_.surface(vertices);
  const auto explained = [&](const Pose& pose) { return appearance_.correlation(levelled, pose, points); };

  // Start the alignment from the flow's guess or the previous pose, whichever explains the picture better.
  const Pose guess = fit_pose(flow_, pose_, vertices);
  const Pose& start = explained(guess) >= explained(pose_) ? guess : pose_;
  TrackedPose found = refine(appearance_, levelled, start, points);
  if (found.confidence < head_tuning::kDoubtBelow) {
    // The tracker may be stuck at a wrong yaw or pitch.
    const TrackedPose other = refine(appearance_, levelled, frontal(found.pose, vertices), points);
    if (other.confidence > found.confidence) found = other;
  }
  pose_ = found.pose;
  before_ = now;
  return found;
}

}  // namespace fbs
