// The options of `fbs remux`.

#include "cli/command_line/verb.h"
#include "cli/remux/remux_arguments.h"

namespace fbs::cli {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  fbs remux talk.fbs talk.mkv                     Matroska, with the sound as a track of its own\n"
    "  fbs remux talk.mkv talk.fbs                     and back: the same bytes\n"
    "  fbs remux talk.mkv - | fbs decode - talk.y4m    through a pipe";

}  // namespace

void add_remux(CLI::App& app, Run& run) {
  const auto [verb, a] = new_verb<RemuxArguments>(
      app, run, "remux", "Put a stream into a Matroska file, or take it out, without loss", run_remux);
  verb->add_option("INPUT", a.input, "Stream (.fbs, or - for standard input) or Matroska file (.mkv)")
      ->required();
  verb->add_option("OUTPUT", a.output, "Matroska file (.mkv) or stream (.fbs, or - for standard output)")
      ->required();
  verb->add_flag("--quiet", a.quiet, "Print nothing but errors");
  verb->footer(kExamples);
}

}  // namespace fbs::cli
