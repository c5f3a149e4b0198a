// What an encoder can be asked for.
#pragma once

#include <optional>

#include "common/picture.h"
#include "encoder/find/marks.h"

namespace fbs {

/// Of a source that is encoded as it happens.
struct LiveSettings {
  double delay = 0.2;  ///< s; pictures are coded in groups of so many seconds
  double buffer = 2;   ///< s; where a bitrate is set: nothing waits longer to be sent at that rate
};

struct EncoderSettings {
  int quality = 50;            ///< 0..100; moves the pattern's quantiser, the steps and lambda together
  double bitrate = 0;          ///< total kbit/s, from which quality follows; 0: quality decides
  double seconds = 0;          ///< length of the video, for bitrate; 0: unknown, ten are assumed
  double motion_bitrate = 0;   ///< kbit/s of the motion alone; 0: quality decides
  int patterns = 0;            ///< of a scene: 1..64; 0: chosen by rate and distortion
  int pattern_quantiser = -1;  ///< of AV1, 0..63; -1: quality decides; for experiments
  std::optional<bool> reduced_patterns;  ///< whether at half width and height; chosen by rate and distortion
  int effort = 1;  ///< 0: patterns are pictures as they are; 1: solved for; 2: and states fitted twice
  int face = 0;    ///< which face to follow, the largest being 0
  std::optional<Marks> marks;  ///< by hand, for the first picture; automatic otherwise
  /// With one pattern: sent in the place of the first picture with a face, of its size and with its face in
  /// the same place. The head and all motion are those of the video.
  std::optional<Picture> first_pattern;
  bool allow_no_face = false;  ///< code a video without any face instead of failing
  bool snakes = true;          ///< follow mouth and brows; off only to measure what they gain
  bool refine = true;          ///< fit the state to the picture; off only to measure what it gains
  bool landmarks = true;       ///< look for landmarks in every picture; off only to measure what it gains
  bool surround = true;        ///< let hair, body and ground move; off only to measure what it gains
  /// Seconds between scenes at the most: where a viewer can join, and damage ends. 0: where it costs little,
  /// up to 40 with several patterns, never with one.
  double key_interval = 0;
  std::optional<LiveSettings> live;  ///< without look-ahead
  /// Live, with 2 or more, a group is coded while the pictures after it are analysed; the stream is the same.
  /// 0: as many as there are cores.
  int threads = 0;
  int group_pictures = 0;  ///< pictures in a motion packet, 1..256; 0: one second's
};

}  // namespace fbs
