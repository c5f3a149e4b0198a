// A talker's head, known from picture 0 with true marks.
#pragma once

#include "encoder/find/adapt.h"
#include "encoder/track/head/head_appearance.h"
#include "tests/unit/talker_clip.h"

namespace fbs {

struct HeadCase {
  explicit HeadCase(int pictures = 40, double yaw_deg = 25)
      : clip([&] {
          auto settings = talker_settings(352, 288, pictures);
          settings.yaw_deg = static_cast<float>(yaw_deg);
          return settings;
        }()),
        head(*adapt_head(clip.marks(0))),
        neutral([&] {
          HeadVertices out;
          for (std::size_t v = 0; v < kVertexCount; ++v) out[v] = glm::dvec3(head.geometry.positions[v]);
          return out;
        }()),
        appearance(neutral, head.pose, frame(0)),
        points(appearance.surface(neutral)) {}

  [[nodiscard]] WorkFrame frame(int picture) {
    return WorkFrame::cut(clip[picture], head.pose.shift, head.pose.eye_distance_px(), false);
  }
  /// Where the head is in a picture, as far as it differs from the first.
  [[nodiscard]] Pose true_pose(int picture) const {
    const Pose now = clip.pose(picture), first = clip.pose(0);
    Pose out = head.pose;
    out.pitch += now.pitch - first.pitch;
    out.yaw += now.yaw - first.yaw;
    out.roll += now.roll - first.roll;
    out.shift += now.shift - first.shift;
    out.log2_scale += now.log2_scale - first.log2_scale;
    return out;
  }

  TalkerClip clip;
  AdaptedHead head;
  HeadVertices neutral;
  HeadAppearance appearance;
  std::vector<glm::dvec3> points;
};

inline double shift_between(const Pose& a, const Pose& b) {
  return std::hypot(a.shift.x - b.shift.x, a.shift.y - b.shift.y) / a.eye_distance_px();
}

}  // namespace fbs
