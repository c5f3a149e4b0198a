// What each verb of the program is asked to do. main.cpp fills these in, one file per verb carries them out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/result.h"

namespace fbs::cli {

struct EncodeArguments {
  std::string input, output;
  int quality = 50;
  double bitrate = 0;  ///< kbit/s in all; 0: as quality says
  std::string patterns = "auto";
  int face = 0;
  std::string marks;    ///< file; empty: automatic
  std::string overlay;  ///< video of the source with mesh and snakes; empty: none
  double sequence_rate = 25;
  bool allow_no_face = false;
  // For measurements; not shown by --help.
  double motion_bitrate = 0;  ///< kbit/s of the motion alone
  bool snakes = true;
  bool refine = true;
  bool surround = true;
  bool quiet = false;
};

struct DecodeArguments {
  std::string input, output;
  std::string sound;        ///< file whose sound goes beside the pictures
  bool keep_going = false;  ///< write what can be decoded of a damaged stream
  bool quiet = false;
};

struct InspectArguments {
  std::string input;
  bool json = false;
};

struct ExportArguments {
  std::string input, output;
};

struct EvaluateArguments {
  std::string source;
  std::string stream;              ///< empty: encode the source first
  std::vector<int> qualities{50};  ///< to encode with, without a stream
  bool json = false;
  bool quiet = false;
};

struct PlayArguments {
  std::string input;
};

/// Errors carry a whole line for the user: what file, what is wrong.
Result<void> run_encode(const EncodeArguments& arguments);
Result<void> run_decode(const DecodeArguments& arguments);
Result<void> run_inspect(const InspectArguments& arguments);
Result<void> run_export(const ExportArguments& arguments);
Result<void> run_evaluate(const EvaluateArguments& arguments);
Result<void> run_play(const PlayArguments& arguments);

/// Verbs that need OpenCV live in modules; these are what the modules export.
inline constexpr const char* kEncoderModule = "fbs_encoder";
inline constexpr const char* kEncodeSymbol = "fbs_run_encode";
inline constexpr const char* kEvaluateSymbol = "fbs_run_evaluate";
inline constexpr const char* kPlayerModule = "fbs_player";
inline constexpr const char* kPlaySymbol = "fbs_run_play";

}  // namespace fbs::cli
