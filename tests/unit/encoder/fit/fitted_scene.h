// A toy scene as PictureFit sees it: smooth paint, 48 pixels between the eyes, pictures drawn by the decoder.
#pragma once

#include "encoder/fit/picture_fit.h"
#include "tests/unit/encoder/fit/seen_scene.h"
#include "tests/unit/toy_scene.h"

namespace fbs {

struct FittedScene {
  static constexpr int kWidth = 320, kHeight = 240;

  Setup setup = toy_setup(kWidth, kHeight);
  State seen = toy_state(160, 96);
  Scene scene;
  PictureFit fit;

  FittedScene() : scene(make()), fit(setup, toy_geometry(), {frame_of(scene.patterns[0].picture), seen}) {}

  [[nodiscard]] Picture drawn(const State& state) const { return rendered(scene, state); }
  void set_picture(const State& state) { fit.set_picture(frame_of(drawn(state))); }

 private:
  Scene make() {
    seen.pose[kLogScale] = static_cast<std::int32_t>(4096 * 5.585);  // 48 pixels
    Picture picture(kWidth, kHeight);
    picture.y = smooth_plane(kWidth, kHeight, 1);
    Scene s;
    s.setup = setup;
    s.geometry.emplace(setup, toy_geometry(), even_surround(10, 8, 0), seen);
    s.patterns.push_back(make_pattern(picture, seen, s.geometry));
    return s;
  }
  static WorkFrame frame_of(const Picture& picture) { return WorkFrame::cut(picture, {160, 96}, 48, true); }
};

/// Turned, shifted, brows raised.
inline State other_state(const FittedScene& s) {
  State state = s.seen;
  state.pose[kYaw] += 3 * kDegree;
  state.pose[kRoll] += 2 * kDegree;
  state.pose[kShiftX] += 2 * 64;
  state.pose[kShiftY] -= 64;
  for (const FeatureId id : {FeatureId::kBrowRight, FeatureId::kBrowLeft})
    for (int i = 0; i < feature(id).control_count; ++i)
      state.control[feature(id).first_control + i] = {0, -350};
  return state;
}

/// With the lower lip hanging.
inline State with_open_mouth(State state) {
  const Feature& inner = feature(FeatureId::kMouthInner);
  for (const int c : {4, 5, 6, 7}) state.control[inner.first_control + c].y = 1000;
  return state;
}

}  // namespace fbs
