// Arguments of `fbs play`.
#pragma once

#include <string>

namespace fbs::cli {

struct PlayArguments {
  std::string input;
  double from = 0;  ///< seconds; where to begin
};

/// The module of the verb, and its function.
inline constexpr const char* kPlayerModule = "fbs_player";
inline constexpr const char* kPlaySymbol = "fbs_run_play";

}  // namespace fbs::cli
