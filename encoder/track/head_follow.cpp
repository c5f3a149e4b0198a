#include "encoder/track/head_follow.h"

#include <utility>

namespace fbs {

bool HeadFollow::recognises(const Picture& picture, const Pose& last, const HeadVertices& vertices) {
  const double size_change = any_framing_ ? head_tuning::kMaxFramingChange : head_tuning::kMaxSizeChange;
  const FaceSearch::Detection found = search_.find_anywhere(picture, head_, last, vertices, size_change);
  if (!found.accepted) return false;
  const Pose& pose = found.head.pose;
  const HeadAppearance& head = head_.appearance();
  const WorkFrame now = WorkFrame::cut(picture, pose.shift, pose.eye_distance_px(), true);
  if (head.colour_difference(now, pose, head.surface(vertices)) > head_tuning::kStrangersColour) return false;
  eye_distance_px_ = pose.eye_distance_px();
  go_on_from(pose, now);
  elsewhere_ = false;
  return true;
}

void HeadFollow::go_on_from(const Pose& pose, const WorkFrame& now) {
  search_.rest();
  head_.restart(pose, now);
}

TrackedPose HeadFollow::track(const WorkFrame& now, const HeadVertices& vertices) {
  const TrackedPose tracked = head_.track(now, vertices);
  confidence_ = tracked.confidence;
  return tracked;
}

std::optional<HeadFollow::Found> HeadFollow::follow(const Picture& picture, const Pose& last,
                                                    const HeadVertices& vertices) {
  if (elsewhere_) {
    confidence_ = 0;
    return std::nullopt;
  }
  WorkFrame now = frame(picture, head_.pose().shift, true);
  // Flow between pictures without the head is meaningless: once lost, the head is searched.
  if (!search_.lost()) {
    const TrackedPose tracked = track(now, vertices);
    if (confidence_ >= FaceSearch::kLostBelow) return Found{tracked.pose, std::move(now)};
  }
  const FaceSearch::Detection found = search_.find(picture, head_, last, vertices);
  confidence_ = found.head.confidence;
  if (!found.accepted) {
    head_.restart(last, now);
    return std::nullopt;
  }
  now = frame(picture, found.head.pose.shift, true);
  go_on_from(found.head.pose, now);
  const TrackedPose tracked = track(now, vertices);
  return Found{tracked.pose, std::move(now)};
}

}  // namespace fbs
