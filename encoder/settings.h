// What an encoder can be asked for.
#pragma once

#include <memory>
#include <optional>

#include "common/picture.h"
#include "encoder/find/marks.h"
#include "encoder/landmarks/landmark_file.h"

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
  /// Of any tracker, by number of the picture pushed: one more start for the fit of each. None: null.
  std::shared_ptr<const LandmarkTrack> landmarks;
  bool allow_no_face = false;  ///< code a video without any face instead of failing
  /// The paper's own path: contours move the mesh, and no state is fitted to a pattern. Light, mouth interior
  /// and gaze are not sent.
  bool track_only = false;
  // Off only to measure what each gains:
  bool expression = true;       ///< send mouth, brows, lids and gaze
  bool contours = true;         ///< the fit begins at the contours; off: where it ended one picture before
  bool descent = true;          ///< snakes descend; off: they stay at the best of their starts
  bool landmark_search = true;  ///< look for landmarks in every picture
  bool surround = true;         ///< let hair, body and ground move
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
