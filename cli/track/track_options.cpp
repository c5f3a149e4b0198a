// The options of `fbs track`.

#include "cli/command_line/verb.h"
#include "cli/source/encoder_module.h"

namespace fbs::cli {
namespace {

constexpr const char* kTrackExamples =
    "Examples:\n"
    "  fbs track talk.mkv talk.csv                     head pose, 68 landmarks, gaze, expression\n"
    "  fbs track talk.mkv talk.json --face 1           of the second largest face\n"
    "  fbs track talk.mkv - | cut -d, -f1-7            pose on standard output\n"
    "  fbs track camera:0 live.csv --duration 10";

}  // namespace

void add_track(CLI::App& app, Run& run) {
  const auto [verb, a] =
      new_verb<TrackArguments>(app, run, "track", "Follow a face, and write its motion as a table",
                               in_module(kEncoderModule, kTrackSymbol));
  verb->add_option("INPUT", a.input,
                   "Video file, - (Y4M on standard input), camera:0, or images (frame_%05d.png or a folder)")
      ->required();
  verb->add_option("OUTPUT", a.output, "Table to write (.csv, .json), or - for standard output")->required();
  verb->add_option("--format", a.format, "Format of the table on standard output (default: csv)")
      ->check(CLI::IsMember({"csv", "json"}))
      ->type_name("csv|json");
  verb->add_option("--marks", a.marks,
                   "JSON file with the positions of facial points in the first picture, as for encode");
  verb->add_option("--face", a.face, "Face to track; 0 is the largest")
      ->capture_default_str()
      ->check(CLI::Range(0, 99));
  verb->add_option("--frames", a.frames, "Track the first N pictures only")
      ->check(CLI::Range(std::int64_t{1}, kMaxFrames))
      ->type_name("N");
  verb->add_option("--duration", a.duration,
                   "Track the first SECONDS only; with --frames, whichever ends first")
      ->check(number_within(0.001, kMaxSeconds))
      ->type_name("SECONDS");
  verb->add_option("--rate", a.sequence_rate, "Pictures per second, for image sequences (default: 25)")
      ->check(number_within(0.01, 1000));
  add_rotate(*verb, a.rotate);
  verb->add_flag("--quiet", a.quiet, "Print no progress bar");
  verb->footer(kTrackExamples);
}

}  // namespace fbs::cli
