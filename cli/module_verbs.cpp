// The verbs that need OpenCV, loaded on demand: its libraries take longer to load than most streams take to
// decode.
#include "cli/module.h"
#include "cli/verbs.h"

namespace fbs::cli {
namespace {

template <class Arguments>
Result<void> run(const char* module, const char* symbol, const Arguments& arguments) {
  auto function = load_module_function<void(const Arguments&, Result<void>&)>(module, symbol);
  if (!function) return fail(function.error());
  Result<void> result;
  (*function)(arguments, result);
  return result;
}

}  // namespace

Result<void> run_encode(const EncodeArguments& arguments) {
  return run(kEncoderModule, kEncodeSymbol, arguments);
}
Result<void> run_evaluate(const EvaluateArguments& arguments) {
  return run(kEncoderModule, kEvaluateSymbol, arguments);
}
Result<void> run_play(const PlayArguments& arguments) {
  return run(kPlayerModule, kPlaySymbol, arguments);
}

}  // namespace fbs::cli
