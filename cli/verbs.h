// Arguments of each verb of the program. main.cpp fills them in; one file per verb carries it out.
#pragma once

#include <csignal>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/result.h"

namespace fbs::cli {

/// How a verb ended that did not fail; the value is the exit code of the program.
enum class Outcome : std::uint8_t {
  kComplete = 0,
  kPartial = 2,  ///< encode: the source was cut off or damaged; what could be read of it was written
  /// decode --keep-going: less than a tenth of the pictures, or an unknown number at the end; inspect
  /// --packets: something is wrong with the stream
  kLittleLost = 3,
  kMuchLost = 4,  ///< decode --keep-going: a tenth of the pictures or more
  kInterrupted =
      128 + SIGINT,  ///< encode: the stream has what was read until then; decode: nothing was written
  kTerminated = 128 + SIGTERM,  ///< the same
};

/// @param signal  SIGINT or SIGTERM
[[nodiscard]] constexpr Outcome outcome_of_stop(int signal) {
  return signal == SIGTERM ? Outcome::kTerminated : Outcome::kInterrupted;
}

struct EncodeArguments {
  std::string input, output;
  int quality = 50;
  double bitrate = 0;        ///< target of the total, kbit/s; 0: none, quality decides
  int patterns = 0;          ///< of a scene; 0: chosen by the encoder
  std::optional<bool> live;  ///< whether it is; nothing: a camera is
  double delay = 0.2;        ///< s, of a live source
  int threads = 0;           ///< of a live source; 0: as many as there are cores
  double buffer = 2;         ///< s, of a live source with a bitrate
  double key_interval = 0;   ///< seconds; 0: where it costs little
  int face = 0;
  std::string marks;                   ///< file; empty: automatic
  std::string overlay;                 ///< video of the source with mesh and snakes drawn on it; empty: none
  std::optional<std::int64_t> frames;  ///< encode at most so many pictures
  std::optional<double> duration;      ///< encode at most so many seconds of the source
  double sequence_rate = 25;
  bool allow_no_face = false;
  // For measurements; not shown by --help.
  double motion_bitrate = 0;   ///< target of the motion alone, kbit/s; 0: none
  int pattern_quantiser = -1;  ///< of AV1; -1: quality decides
  std::optional<bool> reduced_patterns;
  int effort = 1;
  bool snakes = true;
  bool refine = true;
  bool landmarks = true;
  bool surround = true;
  bool quiet = false;
};

struct DecodeArguments {
  std::string input, output;
  std::string sound;        ///< file whose sound is copied into the output
  double from = 0;          ///< seconds; where to begin
  bool vfr = false;         ///< Y4M: write each picture once, whatever its duration
  bool keep_going = false;  ///< decode as much as possible of a damaged stream
  int threads = 0;          ///< that draw each picture; 0: as many as there are cores, up to four
  bool md5 = false;         ///< print the MD5 of each picture; without an output nothing else is written
  bool quiet = false;
};

struct InspectArguments {
  std::string input;
  bool json = false;
  bool packets = false;  ///< list them
};

struct ExportArguments {
  std::string input, output;
};

struct EvaluateArguments {
  std::string source;
  std::string stream;              ///< empty: encode the source
  std::vector<int> qualities{50};  ///< to encode with when there is no stream
  bool live = false;               ///< encode as live pictures are
  bool allow_no_face = false;
  bool json = false;
  bool quiet = false;
};

struct PlayArguments {
  std::string input;
  double from = 0;  ///< seconds; where to begin
};

/// Error texts are complete lines for the user: which file, and what is wrong with it.
Result<Outcome> run_encode(const EncodeArguments& arguments);
Result<Outcome> run_decode(const DecodeArguments& arguments);
Result<Outcome> run_inspect(const InspectArguments& arguments);
Result<void> run_export(const ExportArguments& arguments);
Result<Outcome> run_evaluate(const EvaluateArguments& arguments);
Result<void> run_play(const PlayArguments& arguments);

/// Verbs that need OpenCV are in modules; these are the functions that the modules export.
inline constexpr const char* kEncoderModule = "fbs_encoder";
inline constexpr const char* kEncodeSymbol = "fbs_run_encode";
inline constexpr const char* kEvaluateSymbol = "fbs_run_evaluate";
inline constexpr const char* kPlayerModule = "fbs_player";
inline constexpr const char* kPlaySymbol = "fbs_run_play";

}  // namespace fbs::cli
