// The table that `fbs evaluate` prints.
#pragma once

#include <vector>

#include "cli/evaluate/rate_distortion/clip_report.h"

namespace fbs::cli {

/// A line for each stream of fbs; with several streams or peers also the conclusions.
void print_clip(const ClipReport& clip);

/// A line for each clip, and the means.
void print_clips(const std::vector<ClipReport>& clips);

}  // namespace fbs::cli
