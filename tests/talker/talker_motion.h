// Motion of the talker: settings, head pose and expression of every frame. This is the exact truth.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/picture.h"
#include "tests/talker/talker_face.h"

namespace fbs::talker {

enum class Motion : std::uint8_t {
  kDefault,  ///< talks, raises brows, blinks, looks around, turns the head
  kTurns,    ///< turns the head about one axis after the other, face neutral
  kTalk,     ///< talks and blinks; the head moves by a quarter of its amplitudes
  kBrows,    ///< raises both brows, the right, the left, ...; head held
  kBlink,    ///< blinks every 0.8 s, sometimes with one eye; head held
  kLong,     ///< like default, but forwards and then backwards: the last frame equals the first
};

struct Settings {
  int width = 352;   ///< pixels, 64..8192
  int height = 288;  ///< pixels, 64..8192
  int frame_count = 300;
  Rational frame_rate{30, 1};
  std::uint32_t seed = 1;  ///< of motion, person and texture
  float noise = 0;         ///< deviation of the camera noise, 8-bit levels; half of it in chroma
  float yaw_deg = 12;      ///< amplitudes of the head's rotation
  float pitch_deg = 6;
  float roll_deg = 5;
  float scale = 0.06f;         ///< amplitude of the change of size, fraction
  float light = 0;             ///< amplitude of the change of light, fraction
  float eye_distance = 0.15f;  ///< of the frontal face in frame 0, fraction of the picture's height
  bool still = false;          ///< keeps the pose of frame 0; the face still moves
  Motion motion = Motion::kDefault;
};

/// Weak perspective: screen = scale_px * R * p + shift_px, R = Rz(roll) * Ry(yaw) * Rx(pitch), p in the head
/// frame of talker_face.h, screen in pixels, (0, 0) at the centre of the top left pixel.
/// x right, y down, z away is right-handed, each rotation is the usual matrix of that frame. In the picture:
/// positive pitch looks down, positive yaw turns the nose to the left, positive roll turns clockwise.
struct Pose {
  float pitch_deg = 0, yaw_deg = 0, roll_deg = 0;
  glm::vec2 shift_px{0};
  float scale_px = 1;  ///< eye distance in pixels when frontal
};

[[nodiscard]] glm::mat3 rotation(const Pose& pose);
[[nodiscard]] glm::vec2 project(const Pose& pose, glm::vec3 p);

/// Everything that changes from frame to frame.
struct Moment {
  Pose pose;
  Expression expression;
  float light = 1;  ///< factor on all light
};

/// Something that happens to lids or brows: smooth rise and fall of a strength.
struct Event {
  float start_s, length_s;
  float right, left;  ///< strength on either side
};

/// A target of the mouth or the gaze, reached at `time_s`.
struct Key {
  float time_s;
  glm::vec3 value;
};

/// The plan of a clip; a pure function of its settings. Frame 0 is frontal and neutral.
class Choreography {
 public:
  explicit Choreography(const Settings& settings);

  /// @param frame 0..frame_count - 1
  [[nodiscard]] Moment at(int frame) const;

 private:
  Settings settings_;
  std::vector<Key> mouth_;  ///< open, wide, round
  std::vector<Key> gaze_;   ///< radians right and down
  std::vector<Event> blinks_;
  std::vector<Event> brows_;
};

}  // namespace fbs::talker
