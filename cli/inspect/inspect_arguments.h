// Arguments of `fbs inspect`.
#pragma once

#include <string>

#include "cli/outcome.h"
#include "common/result.h"

namespace fbs::cli {

struct InspectArguments {
  std::string input;
  bool json = false;
  bool packets = false;  ///< list the packets
};

Result<Outcome> run_inspect(const InspectArguments& arguments);

}  // namespace fbs::cli
