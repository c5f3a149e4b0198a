// The report: one file with tables, curves and pictures that needs nothing else.
#pragma once

#include <string>
#include <vector>

#include "cli/evaluate/rate_distortion/clip_report.h"
#include "common/result.h"

namespace fbs::cli {

/// @param file    appears when it is complete
/// @param source  the video or folder, for the title
/// @param clips   at least one
Result<void> write_html(const std::string& file, const std::string& source,
                        const std::vector<ClipReport>& clips);

}  // namespace fbs::cli
