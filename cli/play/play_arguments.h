// Arguments of `fbs play`.
#pragma once

#include <string>

namespace fbs::cli {

struct PlayArguments {
  std::string input;
  std::string source;   ///< video to show beside the stream; empty: none
  std::string record;   ///< output for what is shown; empty: none
  double from = 0;      ///< seconds; where to begin
  bool loop = false;    ///< begin again at the end
  bool paused = false;  ///< show the first picture and wait
  bool no_sound = false;
};

/// The module of the verb, and its function.
inline constexpr const char* kPlayerModule = "fbs_player";
inline constexpr const char* kPlaySymbol = "fbs_run_play";

}  // namespace fbs::cli
