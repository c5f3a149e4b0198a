// The options of `fbs play`.

#include "cli/command_line/verb.h"
#include "cli/play/key_map.h"
#include "cli/play/play_arguments.h"

namespace fbs::cli {
namespace {

constexpr const char* kPlayExamples =
    "Examples:\n"
    "  fbs play talk.fbs\n"
    "  fbs play talk.fbs --from 90                     begin at 1:30\n"
    "  fbs play talk.fbs --source talk.mkv             what it was made of beside it\n"
    "  fbs play talk.fbs --record seen.mp4             keep what the keys make of it\n"
    "  fbs encode camera:0 - --live | fbs play -       look at oneself";

}  // namespace

void add_play(CLI::App& app, Run& run) {
  const auto [verb, a] =
      new_verb<PlayArguments>(app, run, "play", "Play a stream in a window; keys move the face",
                              in_module(kPlayerModule, kPlaySymbol));
  verb->add_option("INPUT", a.input, "Stream to play, or - for standard input")->required();
  add_from(*verb, a.from);
  verb->add_flag("--loop", a.loop, "Begin again at the end");
  verb->add_flag("--paused", a.paused, "Begin paused");
  verb->add_flag("--no-sound", a.no_sound, "Neither play nor record the sound");
  verb->add_option("--source", a.source, "Show this video, of which the stream was made, beside it");
  verb->add_option(
      "--record", a.record,
      "Save what is seen and heard, at the size of the picture and at the speed of the stream: .mp4, .mkv; "
      "without sound: .y4m, frame_%05d.png; while paused, a picture for each change");
  verb->footer("Keys and mouse:\n" + key_help() + "\n\n" + kPlayExamples);
}

}  // namespace fbs::cli
