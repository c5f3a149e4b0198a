// What the verbs of the program share: how they end, and how main.cpp gets to know them.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <memory>

#include "cli/program/module.h"
#include "cli/program/outcome.h"
#include "common/result.h"

namespace fbs::cli {

/// The verb of the command line with all its arguments. Error texts are complete lines for the user: which
/// file, and what is wrong with it.
using Run = std::function<Result<Outcome>()>;

/// Each adds a verb with its options and examples; `run` is set when the command line has it.
void add_encode(CLI::App& app, Run& run);
void add_decode(CLI::App& app, Run& run);
void add_play(CLI::App& app, Run& run);
void add_evaluate(CLI::App& app, Run& run);
void add_inspect(CLI::App& app, Run& run);
void add_export(CLI::App& app, Run& run);
void add_track(CLI::App& app, Run& run);
void add_retarget(CLI::App& app, Run& run);
void add_remux(CLI::App& app, Run& run);
void add_doctor(CLI::App& app, Run& run);
void add_completions(CLI::App& app, Run& run);

/// A verb that is being added, and the arguments that its options fill.
template <class Arguments>
struct NewVerb {
  CLI::App* app;
  Arguments& arguments;  ///< live as long as the app
};

/// @param carry_out  called with the arguments when the command line has the verb
template <class Arguments, class CarryOut>
NewVerb<Arguments> new_verb(CLI::App& app, Run& run, const char* name, const char* about,
                            CarryOut carry_out) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* const verb = app.add_subcommand(name, about)->group("Verbs");
  verb->callback(
      [&run, arguments, carry_out] { run = [arguments, carry_out] { return carry_out(*arguments); }; });
  return {verb, *arguments};
}

/// Calls `void symbol(const Arguments&, Result<Value>&)` of the module.
template <class Value, class Arguments>
Result<Value> run_in_module(const char* module, const char* symbol, const Arguments& arguments) {
  auto function = load_module_function<void(const Arguments&, Result<Value>&)>(module, symbol);
  if (!function) return fail(function.error());
  Result<Value> result;
  (*function)(arguments, result);
  return result;
}

/// A verb that a module carries out (program/module.h), for new_verb(): it needs libraries that take longer
/// to load than most streams take to decode.
inline auto in_module(const char* module, const char* symbol) {
  return
      [module, symbol](const auto& arguments) { return run_in_module<Outcome>(module, symbol, arguments); };
}

/// Options in this group are for measurements, and --help leaves them out.
inline constexpr const char* kHiddenGroup = "for measurements";

inline constexpr double kMaxSeconds = 1e8;  ///< of options that are times: three years
inline constexpr std::int64_t kMaxFrames =
    1'000'000'000;  ///< of options that count pictures: more than a year

/// CLI::Range lets NaN through.
[[nodiscard]] CLI::Validator number_within(double low, double high);

/// --from SECONDS, where a verb begins.
void add_from(CLI::App& verb, double& from);

/// --rotate DEGREES, where a verb reads a video.
void add_rotate(CLI::App& verb, int& degrees);

}  // namespace fbs::cli
