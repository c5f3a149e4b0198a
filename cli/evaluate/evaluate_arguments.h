// Arguments of `fbs evaluate`.
#pragma once

#include <string>
#include <vector>

namespace fbs::cli {

struct EvaluateArguments {
  std::string source;
  std::string stream;              ///< empty: encode the source
  std::vector<int> qualities{50};  ///< to encode with when there is no stream
  bool live = false;               ///< encode as live pictures are
  bool allow_no_face = false;
  bool json = false;
  bool quiet = false;
};

inline constexpr const char* kEvaluateSymbol = "fbs_run_evaluate";  ///< in the encoder's module

}  // namespace fbs::cli
