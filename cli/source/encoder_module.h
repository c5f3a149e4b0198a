// The interface of the module fbs_encoder: its functions, one for each verb that encodes, and their
// arguments.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "encoder/settings.h"

namespace fbs::cli {

inline constexpr const char* kEncoderModule = "fbs_encoder";
inline constexpr const char* kEncodeSymbol = "fbs_run_encode";
inline constexpr const char* kTrackSymbol = "fbs_run_track";
inline constexpr const char* kRetargetSymbol = "fbs_run_retarget";
inline constexpr const char* kEvaluateSymbol = "fbs_run_evaluate";

struct EncodeArguments {
  std::string input, output;
  EncoderSettings settings;              ///< but for what the members below say
  std::optional<bool> live;              ///< whether it is; nothing: a camera is
  std::optional<double> delay;           ///< s, of a live source
  std::optional<double> buffer;          ///< s, of a live source with a bitrate
  std::optional<Resilience> resilience;  ///< of a live source
  std::optional<double> join;            ///< s, of a live source
  std::optional<std::string> sound;      ///< "opus" or "codec2"; nothing: by the bitrates
  std::optional<double> sound_bitrate;   ///< kbit/s; nothing: chosen by that of the pictures
  std::optional<int> track;              ///< of the source's sound, from 0; nothing: the main one
  bool no_sound = false;
  std::string pattern;                  ///< image file: the first pattern; empty: the first picture
  std::string marks;                    ///< file; empty: automatic
  std::string landmarks;                ///< file; empty: none
  std::string overlay;                  ///< video of the source with mesh and snakes drawn on it; empty: none
  std::optional<std::int64_t> frames;   ///< encode at most this many pictures
  std::optional<double> duration;       ///< encode at most this many seconds of the source
  std::optional<double> sequence_rate;  ///< of images, pictures per second; nothing: 25
  int rotate = 0;                       ///< degrees clockwise: 0, 90, 180, 270
  bool quiet = false;
};

struct TrackArguments {
  std::string input, output;
  std::string format;  ///< of the table: "csv", "json"; empty: by the name of the output
  int face = 0;
  std::string marks;                    ///< file; empty: automatic
  std::optional<std::int64_t> frames;   ///< track at most this many pictures
  std::optional<double> duration;       ///< track at most this many seconds of the source
  std::optional<double> sequence_rate;  ///< of images, pictures per second; nothing: 25
  int rotate = 0;                       ///< degrees clockwise: 0, 90, 180, 270
  bool quiet = false;
};

inline constexpr int kPictureQuality = 70;  ///< high: it is sent once

struct RetargetArguments {
  std::string motion;          ///< stream
  std::string face;            ///< stream, or a picture
  std::string output;          ///< stream
  std::string wire_frame;      ///< glTF; empty: the face's
  std::optional<int> quality;  ///< of the picture, 0..100; nothing: kPictureQuality
  bool no_sound = false;       ///< leave out the sound of the motion
  bool quiet = false;
};

/// Default of --quality: from the lowest rate of a recognisable face to where other codecs win.
inline constexpr int kDefaultQualities[] = {20, 35, 50, 65, 80};

struct EvaluateArguments {
  std::string source;                ///< a video, or a folder of them
  std::vector<std::string> streams;  ///< empty: encode the source
  std::vector<int> qualities;        ///< used without streams; empty: kDefaultQualities
  std::vector<double> bitrates;      ///< kbit/s, in place of qualities
  bool live = false;                 ///< encode as live pictures are; the peer is AV1 in real time
  bool allow_no_face = false;
  int rotate = 0;                        ///< of the source, degrees clockwise: 0, 90, 180, 270
  std::optional<std::int64_t> frames;    ///< encode and measure at most this many pictures of the source
  bool peers = false;                    ///< compare with other codecs, too
  std::vector<std::string> peer_codecs;  ///< their names, in small letters; empty: all that ffmpeg has
  std::vector<int> peer_sizes;           ///< divisors of the size; empty: all
  std::vector<int> peer_rates;           ///< divisors of the picture rate; empty: all
  std::string
      region;        ///< table of landmarks, or a stream, that gives the face; empty: the measured streams do
  std::string csv;   ///< file for the values of each picture; empty: none
  std::string html;  ///< file for the report; empty: none
  std::string json;  ///< file for the results; empty: none
  std::string stills;       ///< folder for pictures; empty: none
  std::string keep;         ///< folder for finished results; empty: beside the report, else a temporary one
  std::optional<int> jobs;  ///< videos of a folder evaluated at the same time
  bool quiet = false;
};

}  // namespace fbs::cli
