// The options of `fbs inspect`.

#include "cli/command_line/verb.h"
#include "cli/inspect/inspect_arguments.h"

namespace fbs::cli {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  fbs inspect talk.fbs                            size of each part\n"
    "  fbs inspect talk.fbs --json\n"
    "  fbs inspect broken.fbs --packets                every packet, and what is wrong with it";

}  // namespace

void add_inspect(CLI::App& app, Run& run) {
  const auto [verb, a] = new_verb<InspectArguments>(
      app, run, "inspect", "Show what a stream contains and the size of each part", run_inspect);
  verb->add_option("INPUT", a.input, "Stream to inspect, or - for standard input")->required();
  verb->add_flag("--packets", a.packets,
                 "List every packet, also of a damaged stream: place, type, time of the first picture that "
                 "it concerns, bytes, and what is wrong; exit code 3: something is");
  verb->add_flag("--json", a.json, "Print JSON");
  verb->footer(kExamples);
}

}  // namespace fbs::cli
