// Measurements as JSON and CSV, for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/evaluate/rate_distortion/clip_report.h"
#include "common/result.h"

namespace fbs::cli {

/// {"source", "points": [...], "region", and with peers "peers": [...], "bd_rate"}; see docs/evaluate.md.
[[nodiscard]] nlohmann::json clip_json(const ClipReport& clip);

/// @param file  - is standard output
Result<void> write_json(const std::string& file, const nlohmann::json& results);

/// A line for each picture of each stream, under a header line; see docs/evaluate.md.
Result<void> write_csv(const std::string& file, const std::vector<ClipReport>& clips);

}  // namespace fbs::cli
