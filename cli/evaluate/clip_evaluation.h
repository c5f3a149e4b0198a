// Evaluates one source: streams of fbs, then other codecs, all against the same pictures.
#pragma once

#include <string>
#include <vector>

#include "cli/evaluate/peers/peer_codec.h"
#include "cli/evaluate/rate_distortion/clip_report.h"
#include "cli/evaluate/run/run_folder.h"
#include "cli/files/stop_signal.h"
#include "cli/source/encoder_module.h"
#include "common/result.h"

namespace fbs::cli {

/// What the installed ffmpeg can do.
struct Tools {
  std::vector<PeerCodec> peers;  ///< empty unless asked for
  bool vmaf = false;
};

/// @return kUnsupported when peers are asked for and ffmpeg has none of them
Result<Tools> find_tools(const EvaluateArguments& arguments);

/// Results already in the run folder are reused.
/// @param source  a video; `-` is copied to the run folder first
/// @return errors name the file; kIo when the signal came
Result<ClipReport> evaluate_clip(const EvaluateArguments& arguments, const std::string& source,
                                 const Tools& tools, const RunFolder& run, const StopSignal& stop);

}  // namespace fbs::cli
