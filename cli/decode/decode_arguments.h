// Arguments of `fbs decode`.
#pragma once

#include <string>

#include "cli/program/outcome.h"
#include "common/result.h"

namespace fbs::cli {

struct DecodeArguments {
  std::string input, output;
  std::string sound;        ///< file whose sound is copied into the output
  bool no_sound = false;    ///< leave the stream's sound out
  double from = 0;          ///< seconds; where to begin
  bool vfr = false;         ///< Y4M: write each picture once, whatever its duration
  int thumbnail = 0;        ///< longer side of the one picture to write, pixels; 0: all pictures
  bool keep_going = false;  ///< decode as much as possible of a damaged stream
  int threads = 0;          ///< threads that draw; 0: one per core, up to 16
  bool md5 = false;         ///< print the MD5 of each picture; without an output only that
  bool quiet = false;
};

Result<Outcome> run_decode(const DecodeArguments& arguments);

}  // namespace fbs::cli
