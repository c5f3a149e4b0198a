// A verb that a module carries out (module.h): it needs libraries that take longer to load than most streams
// take to decode.
#pragma once

#include "cli/module.h"
#include "cli/outcome.h"
#include "common/result.h"

namespace fbs::cli {

/// Calls `void symbol(const Arguments&, Result<Value>&)` of the module.
template <class Value, class Arguments>
Result<Value> run_in_module(const char* module, const char* symbol, const Arguments& arguments) {
  auto function = load_module_function<void(const Arguments&, Result<Value>&)>(module, symbol);
  if (!function) return fail(function.error());
  Result<Value> result;
  (*function)(arguments, result);
  return result;
}

/// A verb that does so, for new_verb() (verb.h).
inline auto in_module(const char* module, const char* symbol) {
  return
      [module, symbol](const auto& arguments) { return run_in_module<Outcome>(module, symbol, arguments); };
}

}  // namespace fbs::cli
