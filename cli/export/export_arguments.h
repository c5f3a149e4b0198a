// Arguments of `fbs export`.
#pragma once

#include <string>

#include "cli/outcome.h"
#include "common/result.h"

namespace fbs::cli {

struct ExportArguments {
  std::string input, output;
};

Result<Outcome> run_export(const ExportArguments& arguments);

}  // namespace fbs::cli
