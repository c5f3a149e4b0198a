// A recording of the toy scene for tests of models.
#pragma once

#include "decoder/export/head_recording.h"
#include "tests/unit/toy_scene.h"

namespace fbs {

inline constexpr std::uint32_t kToyDuration = 3000;  ///< of a picture, 1/90000 s

/// The toy head opens its mouth, turns and comes nearer, each at a constant speed.
inline State talking(int picture) {
  State state = toy_state();
  state.pose[kYaw] = 100 * picture;
  state.pose[kRoll] = -50 * picture;
  state.pose[kShiftX] += 32 * picture;
  state.pose[kLogScale] += 20 * picture;
  const Feature& lips = feature(FeatureId::kMouthOuter);
  for (std::size_t i = 6; i < lips.control_count; ++i) state.control[lips.first_control + i].y = 60 * picture;
  return state;
}

/// Adds pictures, one after the other, from the end of the recording on.
inline void record(HeadRecording& recording, const Scene& scene, int pictures) {
  for (int i = 0; i < pictures; ++i)
    recording.add(scene, talking(i), recording.times().size() * kToyDuration, kToyDuration);
}

inline Scene faceless_scene() {
  Scene scene;
  scene.setup = toy_setup();
  scene.patterns.push_back(make_pattern(noise_picture(160, 128, 3), {}, scene.geometry));
  return scene;
}

/// Another person: all of the head a little wider.
inline Scene wider_scene() {
  Scene scene = toy_scene(noise_picture(160, 128, 2));
  Geometry wide = toy_geometry();
  for (auto& p : wide.positions) p.x += p.x / 8;
  scene.set_geometry(SceneGeometry(scene.setup, wide, even_surround(10, 8, 0), toy_state()));
  return scene;
}

/// A state whose control points lie anywhere, by at most a fifth of the eye distance.
inline State grimace(unsigned seed) {
  std::mt19937 random(seed);
  State state = toy_state();
  constexpr int kReach = kUnitsPerEyeDistance / 5;
  for (auto& c : state.control)
    c = {static_cast<int>(random() % (2 * kReach)) - kReach,
         static_cast<int>(random() % (2 * kReach)) - kReach};
  return state;
}

}  // namespace fbs
