#include "tests/talker/talker_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "tests/talker/talker_noise.h"

namespace fbs::talker {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// A stream of hashed numbers.
class Dice {
 public:
  Dice(std::uint32_t seed, std::uint32_t stream) : seed_(seed), stream_(stream) {}
  float between(float low, float high) { return low + (high - low) * hash01(seed_, stream_, ++count_); }

 private:
  std::uint32_t seed_, stream_, count_ = 0;
};

/// Sum of three slow sinusoids within -1..1 that starts at 0 with little speed.
float sway(float time_s, std::uint32_t seed, std::uint32_t stream) {
  constexpr std::array<float, 3> kWeight{0.62f, 0.24f, 0.14f};
  constexpr std::array<float, 3> kPeriod{4.6f, 2.3f, 1.15f};
  float sum = 0;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const float period_s = kPeriod[i] * (0.75f + 0.5f * hash01(seed, stream, i));
    const float sign = hash01(seed, stream, i, 7) < 0.5f ? -1.0f : 1.0f;
    sum += sign * kWeight[i] * std::sin(2 * kPi * time_s / period_s);
  }
  return sum * smooth_step(0.0f, 1.0f, time_s);
}

/// Syllables, 3 to 5 a second, in phrases with pauses.
std::vector<Key> speech(float duration_s, std::uint32_t seed) {
  Dice dice(seed, 101);
  std::vector<Key> keys{{0, {0, 0, 0}}};
  float t = 0.35f;
  while (t < duration_s) {
    keys.push_back({t, {0, 0, 0}});
    const float phrase_end = t + dice.between(1.2f, 3.2f);
    while (t < phrase_end) {
      const float length_s = dice.between(0.20f, 0.33f);
      const float open = dice.between(0.07f, 0.31f);
      const float shape = dice.between(-1, 1);  // rounded .. spread
      const float round = std::max(0.0f, -shape);
      keys.push_back(
          {t + 0.5f * length_s,
           {open * (1 - 0.35f * round), shape > 0 ? 0.06f * shape : 0.10f * shape, 0.09f * round}});
      const bool lips_meet = dice.between(0, 1) < 0.35f;
      keys.push_back({t + length_s,
                      {lips_meet ? 0.0f : dice.between(0.02f, 0.08f), 0.03f * dice.between(-1, 1),
                       0.2f * round * 0.09f}});
      t += length_s;
    }
    keys.push_back({t + 0.15f, {0, 0, 0}});
    t += 0.15f + dice.between(0.35f, 1.0f);
  }
  return keys;
}

std::vector<Key> glances(float duration_s, std::uint32_t seed) {
  Dice dice(seed, 102);
  std::vector<Key> keys{{0, {0, 0, 0}}};
  float t = dice.between(0.9f, 1.8f);
  while (t < duration_s) {
    keys.push_back({t, keys.back().value});
    const bool at_viewer = dice.between(0, 1) < 0.45f;
    const float right = dice.between(-0.28f, 0.28f), down = dice.between(-0.10f, 0.14f);
    keys.push_back({t + 0.07f, at_viewer ? glm::vec3(0) : glm::vec3(right, down, 0)});
    t += dice.between(0.7f, 2.2f);
  }
  return keys;
}

std::vector<Event> blinks(const Settings& s, float duration_s) {
  Dice dice(s.seed, 103);
  const bool often = s.motion == Motion::kBlink;
  std::vector<Event> events;
  float t = often ? 0.4f : dice.between(0.9f, 2.4f);
  for (int i = 0; t < duration_s; ++i) {
    const int who = often ? i % 4 : 0;  // both, both, right, left
    events.push_back({t, 0.2f, who == 3 ? 0.0f : 1.0f, who == 2 ? 0.0f : 1.0f});
    t += often ? 0.8f : dice.between(2.0f, 4.0f);
  }
  return events;
}

std::vector<Event> brow_raises(const Settings& s, float duration_s) {
  Dice dice(s.seed, 104);
  const bool often = s.motion == Motion::kBrows;
  std::vector<Event> events;
  float t = often ? 0.4f : dice.between(1.0f, 2.5f);
  for (int i = 0; t < duration_s; ++i) {
    const float length_s = dice.between(0.6f, 1.3f), height = dice.between(0.06f, 0.13f);
    const int who = often ? i % 3 : (dice.between(0, 1) < 0.75f ? 0 : 1 + i % 2);  // both, right, left
    events.push_back({t, length_s, who == 2 ? 0.2f * height : height, who == 1 ? 0.2f * height : height});
    t += length_s + (often ? 0.2f : dice.between(1.8f, 4.5f));
  }
  return events;
}

/// Value between the keys around `time_s`, by half a cosine.
glm::vec3 interpolate(const std::vector<Key>& keys, float time_s) {
  const auto after = std::upper_bound(keys.begin(), keys.end(), time_s,
                                      [](float t, const Key& key) { return t < key.time_s; });
  if (after == keys.begin()) return keys.front().value;
  const Key& a = *(after - 1);
  if (after == keys.end() || after->time_s <= a.time_s) return a.value;
  const float u = (time_s - a.time_s) / (after->time_s - a.time_s);
  return glm::mix(a.value, after->value, 0.5f - 0.5f * std::cos(kPi * u));
}

/// Strongest event at `time_s`; `flat` is the part of its length spent at full strength.
glm::vec2 strength(const std::vector<Event>& events, float time_s, float flat) {
  glm::vec2 best{0};
  for (const Event& event : events) {
    const float u = (time_s - event.start_s) / event.length_s;
    if (u <= 0 || u >= 1) continue;
    const float ramp = 0.5f * (1.0f - flat);
    const float k = smooth_step(0, ramp, u) * (1.0f - smooth_step(1.0f - ramp, 1.0f, u));
    best = glm::max(best, k * glm::vec2(event.right, event.left));
  }
  return best;
}

/// One axis after the other, 3 s each: 0 .. 1 .. 0 .. -1 .. 0.
float turn(float time_s, int axis) {
  constexpr float kTurnSeconds = 3.0f;
  const float in_round = std::fmod(time_s, 3 * kTurnSeconds);
  return static_cast<int>(in_round / kTurnSeconds) == axis ? std::sin(2 * kPi * in_round / kTurnSeconds)
                                                           : 0.0f;
}

}  // namespace

glm::mat3 rotation(const Pose& pose) {
  const float x = pose.pitch_deg * kPi / 180, y = pose.yaw_deg * kPi / 180, z = pose.roll_deg * kPi / 180;
  // GLM's constructor takes columns.
  const glm::mat3 rx{1, 0, 0, 0, std::cos(x), std::sin(x), 0, -std::sin(x), std::cos(x)};
  const glm::mat3 ry{std::cos(y), 0, -std::sin(y), 0, 1, 0, std::sin(y), 0, std::cos(y)};
  const glm::mat3 rz{std::cos(z), std::sin(z), 0, -std::sin(z), std::cos(z), 0, 0, 0, 1};
  return rz * ry * rx;
}

glm::vec2 project(const Pose& pose, glm::vec3 p) {
  return pose.scale_px * glm::vec2(rotation(pose) * p) + pose.shift_px;
}

Choreography::Choreography(const Settings& settings) : settings_(settings) {
  const float rate =
      static_cast<float>(settings.frame_rate.num) / static_cast<float>(settings.frame_rate.den);
  const float duration_s = static_cast<float>(settings.frame_count) / rate;
  const Motion m = settings.motion;
  const bool all = m == Motion::kDefault || m == Motion::kLong;
  if (all || m == Motion::kTalk) mouth_ = speech(duration_s, settings.seed);
  if (all) gaze_ = glances(duration_s, settings.seed);
  if (all || m == Motion::kTalk || m == Motion::kBlink) blinks_ = blinks(settings, duration_s);
  if (all || m == Motion::kBrows) brows_ = brow_raises(settings, duration_s);
}

Moment Choreography::at(int frame) const {
  const Settings& s = settings_;
  if (s.motion == Motion::kLong) frame = std::min(frame, s.frame_count - 1 - frame);
  const float time_s = static_cast<float>(static_cast<double>(frame) * s.frame_rate.den / s.frame_rate.num);
  const auto height = static_cast<float>(s.height);

  Moment moment;
  Pose& pose = moment.pose;
  pose.scale_px = s.eye_distance * height;
  pose.shift_px = {0.5f * static_cast<float>(s.width - 1), 0.44f * height};
  const bool held = s.still || s.motion == Motion::kBrows || s.motion == Motion::kBlink;
  if (!held && s.motion == Motion::kTurns) {
    pose.pitch_deg = s.pitch_deg * turn(time_s, 1);
    pose.yaw_deg = s.yaw_deg * turn(time_s, 0);
    pose.roll_deg = s.roll_deg * turn(time_s, 2);
  } else if (!held) {
    const float much = s.motion == Motion::kTalk ? 0.25f : 1.0f;
    pose.pitch_deg = much * s.pitch_deg * sway(time_s, s.seed, 1);
    pose.yaw_deg = much * s.yaw_deg * sway(time_s, s.seed, 2);
    pose.roll_deg = much * s.roll_deg * sway(time_s, s.seed, 3);
    pose.shift_px +=
        much * height * glm::vec2(0.028f * sway(time_s, s.seed, 4), 0.014f * sway(time_s, s.seed, 5));
    pose.scale_px *= 1.0f + much * s.scale * sway(time_s, s.seed, 6);
  }

  Expression& e = moment.expression = neutral();
  if (!mouth_.empty()) {
    const glm::vec3 mouth = interpolate(mouth_, time_s);
    e.mouth_open = mouth.x, e.mouth_wide = mouth.y, e.mouth_round = mouth.z;
  }
  if (!gaze_.empty()) e.gaze = glm::vec2(interpolate(gaze_, time_s));
  const glm::vec2 brow = strength(brows_, time_s, 0.4f);
  e.brow_right = brow.x, e.brow_left = brow.y;
  const glm::vec2 shut = strength(blinks_, time_s, 0.2f);
  const float looks_down = 1.0f - 0.6f * e.gaze.y;  // the lid follows the gaze
  e.eye_open_right = kEyeOpenNeutral * (looks_down + 0.8f * brow.x) * (1.0f - shut.x);
  e.eye_open_left = kEyeOpenNeutral * (looks_down + 0.8f * brow.y) * (1.0f - shut.y);
  moment.light = 1.0f + s.light * sway(time_s, s.seed, 8);
  return moment;
}

}  // namespace fbs::talker
