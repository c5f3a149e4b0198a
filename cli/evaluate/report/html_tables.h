// The tables of the report.
#pragma once

#include <string>
#include <vector>

#include "cli/evaluate/rate_distortion/clip_report.h"

namespace fbs::cli {

/// A number such as "4.2".
[[nodiscard]] std::string decimal(double value, int digits);

/// The label; for a given stream only the file's name.
[[nodiscard]] std::string point_name(const RdPoint& point);

/// Table of the streams of fbs.
[[nodiscard]] std::string point_table(const ClipReport& clip);

/// Table of other codecs' streams, folded; empty without any.
[[nodiscard]] std::string peer_table(const ClipReport& clip);

/// Table of all clips, and means.
[[nodiscard]] std::string clip_table(const std::vector<ClipReport>& clips);

}  // namespace fbs::cli
