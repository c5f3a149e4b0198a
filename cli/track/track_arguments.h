// Arguments of `fbs track`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace fbs::cli {

struct TrackArguments {
  std::string input, output;
  std::string format;  ///< of the table: "csv", "json"; empty: by the name of the output
  int face = 0;
  std::string marks;                    ///< file; empty: automatic
  std::optional<std::int64_t> frames;   ///< track at most this many pictures
  std::optional<double> duration;       ///< track at most this many seconds of the source
  std::optional<double> sequence_rate;  ///< of images, pictures per second; nothing: 25
  bool quiet = false;
};

inline constexpr const char* kTrackSymbol = "fbs_run_track";  ///< in the encoder's module

}  // namespace fbs::cli
