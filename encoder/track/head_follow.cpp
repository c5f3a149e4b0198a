#include "encoder/track/head_follow.h"

#include <utility>

namespace fbs {

bool HeadFollow::recognises(const Picture& picture, const Pose& last, const HeadVertices& vertices) {
  const FaceSearch::Detection found = search_.find_anywhere(picture, head_, last, vertices);
  if (!found.accepted) return false;
  const Pose& pose = found.head.pose;
  head_.restart(pose, frame(picture, pose.shift, true));
  search_.rest();
  elsewhere_ = false;
  return true;
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
    const TrackedPose tracked = head_.track(now, vertices);
    confidence_ = tracked.confidence;
    if (confidence_ >= FaceSearch::kLostBelow) return Found{tracked.pose, std::move(now)};
  }
  const FaceSearch::Detection found = search_.find(picture, head_, last, vertices);
  confidence_ = found.head.confidence;
  if (!found.accepted) {
    head_.restart(last, now);
    return std::nullopt;
  }
  search_.rest();
  now = frame(picture, found.head.pose.shift, true);
  head_.restart(found.head.pose, now);
  const TrackedPose tracked = head_.track(now, vertices);
  confidence_ = tracked.confidence;
  return Found{tracked.pose, std::move(now)};
}

}  // namespace fbs
