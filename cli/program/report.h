// What fbs tells a program that runs it: lines on the file descriptor whose number FBS_REPORT_FD has.
// docs/usage.md says what is in them. Without it, nothing is told.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/result.h"

namespace fbs {

/// True when somebody listens.
[[nodiscard]] bool reports();

/// "progress DONE TOTAL LABEL"; TOTAL is - where nobody knows it.
void report_progress(const std::string& label, std::int64_t done, std::optional<std::int64_t> total);

/// "error CODE": the program fails with a line on standard error that says more.
void report_error(ErrorCode code);
/// The same, for lack of memory.
void report_no_memory();

}  // namespace fbs
