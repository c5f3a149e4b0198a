// The verbs that need OpenCV, loaded on demand: its libraries take longer to load than most streams take to
// decode.
#include "cli/module.h"
#include "cli/verbs.h"

namespace fbs::cli {
namespace {

template <class Value, class Arguments>
Result<Value> run(const char* module, const char* symbol, const Arguments& arguments) {
  auto function = load_module_function<void(const Arguments&, Result<Value>&)>(module, symbol);
  if (!function) return fail(function.error());
  Result<Value> result;
  (*function)(arguments, result);
  return result;
}

}  // namespace

Result<Outcome> run_encode(const EncodeArguments& arguments) {
  return run<Outcome>(kEncoderModule, kEncodeSymbol, arguments);
}
Result<Outcome> run_evaluate(const EvaluateArguments& arguments) {
  return run<Outcome>(kEncoderModule, kEvaluateSymbol, arguments);
}
Result<void> run_play(const PlayArguments& arguments) {
  return run<void>(kPlayerModule, kPlaySymbol, arguments);
}

}  // namespace fbs::cli
