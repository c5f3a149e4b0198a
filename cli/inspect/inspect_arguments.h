// Arguments of `fbs inspect`.
#pragma once

#include <string>

#include "cli/program/outcome.h"
#include "common/result.h"

namespace fbs::cli {

struct InspectArguments {
  std::string input;
  bool json = false;
  bool packets = false;  ///< list them
};

Result<Outcome> run_inspect(const InspectArguments& arguments);

}  // namespace fbs::cli
