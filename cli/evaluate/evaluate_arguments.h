// Arguments of `fbs evaluate`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace fbs::cli {

/// Default of --quality: from the lowest rate of a recognisable face to where other codecs win.
inline constexpr int kDefaultQualities[] = {20, 35, 50, 65, 80};

struct EvaluateArguments {
  std::string source;                ///< a video, or a folder of them
  std::vector<std::string> streams;  ///< empty: encode the source
  std::vector<int> qualities;        ///< used without streams; empty: kDefaultQualities
  bool live = false;                 ///< encode as live pictures are
  bool allow_no_face = false;
  std::optional<std::int64_t> frames;    ///< encode and measure at most this many pictures of the source
  bool peers = false;                    ///< compare with other codecs, too
  std::vector<std::string> peer_codecs;  ///< their names, in small letters; empty: all that ffmpeg has
  std::vector<int> peer_sizes;           ///< divisors of the size; empty: all
  std::vector<int> peer_rates;           ///< divisors of the picture rate; empty: all
  std::string
      region;        ///< table of landmarks, or a stream, that gives the face; empty: the measured streams do
  std::string csv;   ///< file for the values of each picture; empty: none
  std::string html;  ///< file for the report; empty: none
  std::string stills;       ///< folder for pictures; empty: none
  std::string keep;         ///< folder for finished results; empty: beside the report, else a temporary one
  std::optional<int> jobs;  ///< videos of a folder evaluated at the same time
  bool json = false;
  bool quiet = false;
};

inline constexpr const char* kEvaluateSymbol = "fbs_run_evaluate";  ///< in the encoder's module

}  // namespace fbs::cli
