// The command line of the program talker.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "tests/talker/talker_motion.h"

namespace fbs::talker {

struct Options {
  std::string video;  ///< path, or "-" for standard output
  std::string truth;  ///< path of the CSV; empty for none
  std::string marks;  ///< path of the JSON; empty for none
  bool help = false;
  Settings settings;
};

extern const std::string_view kUsage;

/// @param arguments  without the program's name
/// @param complaint  set to one line when nothing is returned
[[nodiscard]] std::optional<Options> parse_options(std::span<char* const> arguments, std::string& complaint);

}  // namespace fbs::talker
