// Verbs that Ctrl-C and SIGTERM end with partial results.
#pragma once

#include <functional>

#include "cli/files/stop_signal.h"
#include "cli/program/outcome.h"
#include "common/result.h"

namespace fbs::cli {

/// Runs `work`, which watches the signal, and says on standard error if one has come.
/// @param notice   printed when it comes; must outlive the call
/// @param nothing  printed if `work` then fails: "nothing written"
[[nodiscard]] Result<Outcome> until_stopped(bool quiet, const char* notice, const char* nothing,
                                            const std::function<Result<Outcome>(const StopSignal&)>& work);

}  // namespace fbs::cli
