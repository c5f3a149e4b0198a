// Arguments of `fbs remux`.
#pragma once

#include <string>

#include "cli/program/outcome.h"
#include "common/result.h"

namespace fbs::cli {

struct RemuxArguments {
  std::string input, output;
  bool quiet = false;
};

Result<Outcome> run_remux(const RemuxArguments& arguments);

}  // namespace fbs::cli
