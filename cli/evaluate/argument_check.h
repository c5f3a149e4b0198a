// Checks which options of `fbs evaluate` may be combined.
#pragma once

#include <vector>

#include "cli/evaluate/evaluate_arguments.h"
#include "common/result.h"

namespace fbs::cli {

/// @param clips  videos in the folder; empty where the source is a video itself
/// @return kInvalidArgument for an option without effect, and for an output that is an input
Result<void> check_arguments(const EvaluateArguments& arguments, const std::vector<std::string>& clips);

}  // namespace fbs::cli
