#include "encoder/track/head_follow.h"

#include <utility>

namespace fbs {

bool HeadFollow::recognises(const Picture& picture, const Pose& last, const HeadVertices& vertices) {
  const FaceSearch::Detection found = search_.find_anywhere(picture, head_, last, vertices);
  if (!found.accepted) return false;
  (void)go_on_from(picture, found.head.pose);
  elsewhere_ = false;
  return true;
}

WorkFrame HeadFollow::go_on_from(const Picture& picture, const Pose& pose) {
  search_.rest();
  WorkFrame now = frame(picture, pose.shift, true);
  head_.restart(pose, now);
  return now;
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
  now = go_on_from(picture, found.head.pose);
  const TrackedPose tracked = track(now, vertices);
  return Found{tracked.pose, std::move(now)};
}

}  // namespace fbs
