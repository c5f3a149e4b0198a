// The generated talker for the encoder's tests: pictures drawn once, truth in the encoder's conventions.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "encoder/find/marks.h"
#include "encoder/landmarks/shape.h"
#include "encoder/model/pose.h"
#include "tests/talker/talker_render.h"

namespace fbs {

class TalkerClip {
 public:
  explicit TalkerClip(const talker::Settings& settings) : talker_(settings) {}

  [[nodiscard]] int count() const { return talker_.settings().frame_count; }
  [[nodiscard]] const talker::Talker& talker() const { return talker_; }

  [[nodiscard]] const Picture& operator[](int frame) {
    auto found = drawn_.find(frame);
    if (found == drawn_.end()) found = drawn_.emplace(frame, talker_.picture(frame)).first;
    return found->second;
  }

  [[nodiscard]] VideoFormat format() const {
    VideoFormat f;
    f.width = talker_.settings().width;
    f.height = talker_.settings().height;
    f.frame_rate = talker_.settings().frame_rate;
    return f;
  }

  /// The 68 points where they are seen; the talker counts from the first pixel's centre, marks from its
  /// corner.
  [[nodiscard]] Marks marks(int frame) const {
    Marks m;
    const Shape points = shape(frame);
    for (int k = 0; k < kLandmarkCount; ++k) m.set_landmark(k, glm::dvec2(points[k]));
    return m;
  }

  [[nodiscard]] Shape shape(int frame) const {
    Shape out;
    std::ranges::transform(talker_.points(frame), out.begin(), [](glm::vec2 p) { return p + 0.5F; });
    return out;
  }

  /// Head frames differ in their origins, so that only turns, scale and changes of the pose are comparable.
  [[nodiscard]] Pose pose(int frame) const {
    constexpr double kDegree = std::numbers::pi / 180;
    const talker::Pose p = talker_.truth(frame).pose;
    Pose out;
    out.pitch = static_cast<double>(p.pitch_deg) * kDegree;
    out.yaw = static_cast<double>(p.yaw_deg) * kDegree;
    out.roll = static_cast<double>(p.roll_deg) * kDegree;
    out.shift = glm::dvec2(p.shift_px) + 0.5;
    out.log2_scale = std::log2(static_cast<double>(p.scale_px));
    return out;
  }

 private:
  talker::Talker talker_;
  std::map<int, Picture> drawn_;
};

inline talker::Settings talker_settings(int width, int height, int frames) {
  talker::Settings s;
  s.width = width;
  s.height = height;
  s.frame_count = frames;
  return s;
}

}  // namespace fbs
