// How a verb ended that did not fail.
#pragma once

#include <csignal>
#include <cstdint>

namespace fbs::cli {

/// The value is the exit code of the program.
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

}  // namespace fbs::cli
