// A scene whose pattern was seen in any state, drawn by the decoder and compared as in the fit.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "encoder/fit/comparison.h"
#include "tests/unit/toy_scene.h"

namespace fbs {

/// Luma without edges, so that a place between samples has a definite value: waves of random direction.
inline Plane wave_plane(int width, int height, unsigned seed) {
  constexpr int kWaves = 6;
  constexpr double kMinLength = 28;  // samples
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  std::array<std::array<double, 3>, kWaves> waves;  // per sample across and down, phase
  for (auto& [u, v, phase] : waves) {
    const double angle = 2 * std::numbers::pi * share(random);
    const double k = 2 * std::numbers::pi / (kMinLength * (1 + share(random)));
    u = k * std::cos(angle), v = k * std::sin(angle), phase = 2 * std::numbers::pi * share(random);
  }
  Plane out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double sum = 0;
      for (const auto& [u, v, phase] : waves) sum += std::sin(u * x + v * y + phase);
      out.row(y)[x] = static_cast<std::uint8_t>(std::lround(128 + 12 * sum));
    }
  return out;
}

inline constexpr std::int32_t kDegree = 65536 / 360;  ///< units of State::pose

/// Random states of a talking head, part by part.
class StateMaker {
 public:
  explicit StateMaker(unsigned seed) : random_(seed) {}

  void pose(State& s) {
    for (const int angle : {kPitch, kYaw, kRoll}) s.pose[angle] += up_to(10 * kDegree);
    s.pose[kShiftX] += up_to(5 * 64);
    s.pose[kShiftY] += up_to(5 * 64);
    s.pose[kLogScale] += up_to(300);
  }
  void expression(State& s) {
    for (const FeatureId id :
         {FeatureId::kMouthOuter, FeatureId::kBrowRight, FeatureId::kBrowLeft, FeatureId::kLowerLidLeft})
      for (int i = 0; i < feature(id).control_count; ++i)
        s.control[feature(id).first_control + i] += glm::ivec2(up_to(120), up_to(120));
  }
  void lids(State& s) {
    const int down = static_cast<int>(random_() % 1100);
    for (const FeatureId id : {FeatureId::kUpperLidRight, FeatureId::kUpperLidLeft})
      for (int i = 0; i < 2; ++i) s.control[feature(id).first_control + i].y += down;
  }
  void gaze(State& s) {
    for (const FeatureId id : {FeatureId::kPupilRight, FeatureId::kPupilLeft})
      s.control[feature(id).first_control] += glm::ivec2(up_to(150), up_to(100));
  }
  void mouth(State& s) {
    const int down = 200 + static_cast<int>(random_() % 600);
    for (const int c : {4, 5, 6, 7}) s.control[feature(FeatureId::kMouthInner).first_control + c].y += down;
    for (const int c : {5, 6, 7, 8, 9})
      s.control[feature(FeatureId::kMouthOuter).first_control + c].y += down;
    for (auto& level : s.interior) level = up_to(30 * 16);
  }
  void light(State& s) {
    for (auto& level : s.light) level = up_to(12 * 16);
  }

 private:
  int up_to(int limit) { return std::uniform_int_distribution<int>(-limit, limit)(random_); }
  std::mt19937 random_;
};

/// 48 pixels between the eyes, so that the work frame is the picture itself.
struct SeenScene {
  static constexpr int kWidth = 320, kHeight = 240;

  static State rest() {
    State state = toy_state(160, 96);
    state.pose[kLogScale] = static_cast<std::int32_t>(4096 * 5.585);  // 48 pixels
    return state;
  }
  static WorkFrame frame_of(const Picture& picture) {
    return WorkFrame::cut(picture, {160, 96}, WorkFrame::kWorkEyeDistance, true);
  }

  State seen;
  Scene scene;
  Comparison comparison;

  SeenScene(const State& seen_state, const Plane& luma)
      : seen(seen_state),
        scene(make(luma)),
        comparison(
            Comparison::with(scene.setup, toy_geometry(), {frame_of(scene.patterns[0].picture), seen})) {}

  [[nodiscard]] Picture drawn(const State& state) const { return rendered(scene, state); }
  void set_picture(const Picture& picture) { comparison.picture = LumaPyramid(frame_of(picture)); }

 private:
  Scene make(const Plane& luma) const {
    Picture picture(kWidth, kHeight);
    picture.y = luma;
    Scene s;
    s.setup = toy_setup(kWidth, kHeight);
    s.geometry.emplace(s.setup, toy_geometry(), even_surround(10, 8, 0), rest());
    s.patterns.push_back(make_pattern(picture, seen, s.geometry));
    return s;
  }
};

}  // namespace fbs
