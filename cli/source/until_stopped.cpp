#include "cli/source/until_stopped.h"

#include <cstdio>

namespace fbs::cli {

Result<Outcome> until_stopped(bool quiet, const char* notice, const char* nothing,
                              const std::function<Result<Outcome>(const StopSignal&)>& work) {
  const StopSignal stop(quiet ? nullptr : notice);
  auto outcome = work(stop);
  if (!stop.raised()) return outcome;
  if (!outcome)
    std::fprintf(stderr, "fbs: stopped by %s; %s: %s\n", stop.name(), nothing, outcome.error().text.c_str());
  else if (!quiet)
    std::fprintf(stderr, "fbs: stopped by %s\n", stop.name());
  return outcome_of_stop(stop.number());
}

}  // namespace fbs::cli
