// Arguments of `fbs encode`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace fbs::cli {

struct EncodeArguments {
  std::string input, output;
  int quality = 50;
  double bitrate = 0;                   ///< target of the total, kbit/s; 0: none, quality decides
  int patterns = 0;                     ///< of a scene; 0: chosen by the encoder
  std::optional<bool> live;             ///< whether it is; nothing: a camera is
  std::optional<double> delay;          ///< s, of a live source
  std::optional<int> threads;           ///< of a live source; nothing: as many as there are cores
  std::optional<double> buffer;         ///< s, of a live source with a bitrate
  double key_interval = 0;              ///< seconds; 0: where it costs little
  std::optional<std::string> sound;     ///< "opus" or "codec2"; nothing: by the bitrates
  std::optional<double> sound_bitrate;  ///< kbit/s; nothing: chosen by the pictures' rate
  std::optional<int> track;             ///< of the source's sound, from 0; nothing: the main one
  bool no_sound = false;
  int face = 0;
  std::string pattern;    ///< image file: the first pattern; empty: the first picture
  std::string marks;      ///< file; empty: automatic
  std::string landmarks;  ///< file; empty: none
  bool track_only = false;
  std::string overlay;  ///< video of the source with mesh and snakes drawn over it; empty: none
  std::optional<std::int64_t> frames;   ///< encode at most this many pictures
  std::optional<double> duration;       ///< encode at most this many seconds of the source
  std::optional<double> sequence_rate;  ///< of images, pictures per second; nothing: 25
  bool allow_no_face = false;
  // For measurements; not shown by --help.
  double motion_bitrate = 0;   ///< target of the motion alone, kbit/s; 0: none
  int pattern_quantiser = -1;  ///< of AV1; -1: quality decides
  std::optional<bool> reduced_patterns;
  int effort = 1;
  bool expression = true;
  bool contours = true;
  bool descent = true;
  bool landmark_search = true;
  bool surround = true;
  bool quiet = false;
};

/// The module of the verbs that encode, and the function of this one.
inline constexpr const char* kEncoderModule = "fbs_encoder";
inline constexpr const char* kEncodeSymbol = "fbs_run_encode";

}  // namespace fbs::cli
