// The settings of an encoder.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "common/hooks.h"
#include "common/picture.h"
#include "encoder/effort.h"
#include "encoder/find/marks.h"
#include "encoder/landmarks/landmark_file.h"

namespace fbs {

/// What a live stream does to survive lost packets.
enum class Resilience : std::uint8_t {
  kNone,    ///< nothing: least bytes
  kPacket,  ///< motion needs the head of its scene alone; patterns need those before them, so that lost
            ///< packets are to be sent again
  kStrong,  ///< patterns, too, need the head of their scene alone; that is sent again, and so are groups with
            ///< a pattern: for links without a way back
};

/// For a source that is encoded as it happens.
struct LiveSettings {
  double delay = 0.2;  ///< s; pictures that are coded together, in groups of a second at most
  double buffer = 2;   ///< s; with a bitrate: longest time that data waits to be sent at that rate
  Resilience resilience = Resilience::kNone;
  /// s; the head of a scene is sent again in parts, so that a viewer who comes in its middle, or has lost the
  /// head, can join it within this time if a tenth of the packets is lost. 0: only where a scene begins.
  double join = 0;

  /// Whether viewers may have a scene's first pattern and none of those behind it.
  [[nodiscard]] bool relies_on_first() const { return resilience == Resilience::kStrong || join > 0; }
};

/// What bytes are spent for.
enum class Tune : std::uint8_t {
  kEye,   ///< the face, where viewers look: mouth and eyes are nearer to the source, what surrounds them less
  kPsnr,  ///< the frame as a whole: least squared difference
};

/// Longest segment of a file, seconds: pictures not yet coded are on disk, and its end is a delay.
inline constexpr double kSegmentSeconds = 40;

struct EncoderSettings {
  int quality = 50;    ///< 0..100; moves the pattern's quantiser, the steps and lambda together
  double bitrate = 0;  ///< total kbit/s, which determines quality; 0: quality decides
  double seconds = 0;  ///< length of the video, for bitrate; 0: unknown, ten are assumed
  /// With a bitrate, s of it: the first picture is there after so long, coarse if need be, and a finer
  /// pattern follows. As coarse as can be it may still take longer. 0: as fine as the rate as a whole allows.
  /// Empty: 1 live, or the buffer if that is less, unless LiveSettings::relies_on_first(), otherwise 0.
  std::optional<double> start;
  double motion_bitrate = 0;             ///< kbit/s of the motion alone; 0: quality decides
  Tune tune = Tune::kEye;                ///< of files: live patterns are all of one contrast
  int patterns = 0;                      ///< of a scene: 1..64; 0: chosen by rate and distortion
  int pattern_quantiser = -1;            ///< of AV1, 0..63; -1: quality decides; for experiments
  std::optional<bool> reduced_patterns;  ///< whether at half width and height; chosen by rate and distortion
  int effort = Effort::kDefault;         ///< 0..Effort::kMost: more takes longer and fewer bytes
  int face = 0;                          ///< which face to follow, the largest being 0
  std::optional<Marks> marks;            ///< by hand, for the first picture; automatic otherwise
  /// With one pattern: sent in place of the first picture with a face; has its size, and its face in the same
  /// place. The head and all motion come from the video.
  std::optional<Picture> first_pattern;
  /// Landmarks from any tracker, by number of the picture pushed: an additional start for each fit. Null:
  /// none.
  std::shared_ptr<const LandmarkTrack> landmarks;
  bool allow_no_face = false;  ///< code a video without any face instead of failing
  /// The paper's own path: contours move the mesh, and no state is fitted to a pattern. Light, mouth interior
  /// and gaze are not sent.
  bool track_only = false;
  // Off only to measure their gains:
  bool expression = true;       ///< send mouth, brows, lids and gaze
  bool contours = true;         ///< the fit starts from the contours; off: from the previous picture's fit
  bool descent = true;          ///< snakes descend; off: they stay at the best of their starts
  bool landmark_search = true;  ///< look for landmarks in every picture
  bool surround = true;         ///< let hair, body and ground move
  /// Longest time between scenes, s: where viewers can join and damage ends. 0: where it costs little, up to
  /// 40 with several patterns, never with one; live 10, 20 with kStrong and 40 with `join`.
  double key_interval = 0;
  std::optional<LiveSettings> live;  ///< without look-ahead
  /// The stream is the same for any number. 0: as many as there are cores.
  int threads = 0;
  Hooks hooks{};
  int group_pictures = 0;  ///< pictures in a motion packet, 1..256; 0: one second's
};

}  // namespace fbs
