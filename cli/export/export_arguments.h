// Arguments of `fbs export`.
#pragma once

#include <string>

#include "cli/program/outcome.h"
#include "common/result.h"

namespace fbs::cli {

struct ExportArguments {
  std::string input, output;
  std::string format;  ///< of a table: "csv", "json"; empty: by the name of the output
  bool draco = false;  ///< of a .glb or .gltf
};

Result<Outcome> run_export(const ExportArguments& arguments);

}  // namespace fbs::cli
