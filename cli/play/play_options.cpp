// The options of `fbs play`.
#include <memory>

#include "cli/module_verb.h"
#include "cli/play/play_arguments.h"
#include "cli/verb.h"

namespace fbs::cli {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  fbs play talk.fbs\n"
    "  fbs play talk.fbs --from 90                     begin at 1:30";

}  // namespace

void add_play(CLI::App& app, Run& run) {
  const auto arguments = std::make_shared<PlayArguments>();
  PlayArguments& a = *arguments;
  CLI::App* verb = app.add_subcommand(
      "play", "Play a stream in a window (space: pause, .: step, p: patterns, r: restart, q: quit)");
  verb->add_option("INPUT", a.input, "Stream to play")->required();
  add_from(*verb, a.from);
  verb->footer(kExamples);
  verb->callback([&run, arguments] {
    run = [arguments] { return run_in_module<Outcome>(kPlayerModule, kPlaySymbol, *arguments); };
  });
}

}  // namespace fbs::cli
