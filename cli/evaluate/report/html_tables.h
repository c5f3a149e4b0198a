// The tables of the report.
#pragma once

#include <string>
#include <vector>

#include "cli/evaluate/rate_distortion/clip_report.h"

namespace fbs::cli {

/// "4.2"
[[nodiscard]] std::string decimal(double value, int digits);

/// The label, or of a stream the name of the file alone.
[[nodiscard]] std::string point_name(const RdPoint& point);

/// Streams of fbs.
[[nodiscard]] std::string point_table(const ClipReport& clip);

/// Streams of other codecs, folded; nothing without any.
[[nodiscard]] std::string peer_table(const ClipReport& clip);

/// All clips, and means.
[[nodiscard]] std::string clip_table(const std::vector<ClipReport>& clips);

}  // namespace fbs::cli
