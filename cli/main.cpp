// The program fbs: reads the command line and hands over to a verb.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>

#include "cli/verbs.h"

namespace {

using fbs::cli::DecodeArguments;
using fbs::cli::EncodeArguments;
using fbs::cli::EvaluateArguments;
using fbs::cli::ExportArguments;
using fbs::cli::InspectArguments;
using fbs::cli::PlayArguments;

constexpr int kFailed = 2;

constexpr const char* kAbout =
    "fbs, a video codec for talking heads: it sends a person once, and then only how the person moves.\n";

constexpr const char* kExamples =
    "Examples:\n"
    "  fbs encode talk.mkv talk.fbs                    encode; prints bytes, kbit/s and PSNR\n"
    "  fbs encode talk.mkv talk.fbs --quality 70       better and larger\n"
    "  fbs encode talk.mkv talk.fbs --overlay see.mp4  and look at what the tracker saw\n"
    "  fbs decode talk.fbs talk.y4m                    or .mp4, .mkv, frame_%05d.png, - for a pipe\n"
    "  fbs decode talk.fbs - | mpv -                   decode into a player\n"
    "  fbs play talk.fbs                               in a window\n"
    "  fbs evaluate talk.mkv --quality 30 50 70        rate and distortion at three qualities\n"
    "  fbs inspect talk.fbs                            bytes by part\n"
    "  fbs export talk.fbs talk.csv                    pose and 68 landmarks per picture\n"
    "\n"
    "`fbs VERB --help` tells more. Exit code: 0 done, 2 failed, with one line on standard error.";

using Run = std::function<fbs::Result<void>()>;

void add_encode(CLI::App& app, EncodeArguments& a, Run& run) {
  CLI::App* verb = app.add_subcommand("encode", "Encode a video");
  verb->add_option(
          "INPUT", a.input,
          "Video file, .y4m, - (Y4M on standard input), camera:0, or images (frame_%05d.png, a folder)")
      ->required();
  verb->add_option("OUTPUT", a.output, "The stream to write, .fbs")->required();
  verb->add_option("--quality", a.quality, "0 (smallest) to 100 (best)")
      ->capture_default_str()
      ->check(CLI::Range(0, 100));
  verb->add_option("--bitrate", a.bitrate, "Aim at this many kbit/s in all instead of a quality")
      ->check(CLI::Range(0.1, 10000.0))
      ->excludes("--quality");
  verb->add_option("--patterns", a.patterns, "Pictures of the person to send; so far there is one, the first")
      ->capture_default_str()
      ->check(CLI::IsMember({"auto", "1"}));
  verb->add_option("--marks", a.marks,
                   "JSON file of points on the first picture, {\"nose_tip\": [x, y], ...} or {\"landmarks\": "
                   "[68 points]}; "
                   "found automatically otherwise");
  verb->add_option("--face", a.face, "Which face to follow; 0 is the largest")
      ->capture_default_str()
      ->check(CLI::Range(0, 99));
  verb->add_option("--overlay", a.overlay,
                   "Also write the source with mesh and snakes drawn on it (.mp4, .mkv, .y4m)");
  verb->add_option("--rate", a.sequence_rate, "Pictures per second of an image sequence")
      ->capture_default_str()
      ->check(CLI::Range(0.01, 1000.0));
  verb->add_flag("--allow-no-face", a.allow_no_face,
                 "Code a video without a face as a still picture instead of failing");
  verb->add_flag("--quiet", a.quiet, "No progress bar, no closing line");
  verb->add_flag("!--no-snakes", a.snakes)->group("");
  verb->add_flag("!--no-refine", a.refine)->group("");
  verb->add_flag("!--still-surround", a.surround)->group("");
  verb->add_option("--motion-bitrate", a.motion_bitrate)->check(CLI::Range(0.05, 1000.0))->group("");
  verb->callback([&] { run = [&] { return run_encode(a); }; });
}

void add_decode(CLI::App& app, DecodeArguments& a, Run& run) {
  CLI::App* verb = app.add_subcommand("decode", "Decode a stream into pictures");
  verb->add_option("INPUT", a.input, "The stream, or - for standard input")->required();
  verb->add_option("OUTPUT", a.output,
                   ".y4m, - (Y4M on standard output), .mp4, .mkv, frame_%05d.png, or null:")
      ->required();
  verb->add_option("--sound", a.sound, "Put the sound of this file beside the pictures (.mp4, .mkv)");
  verb->add_flag("--keep-going", a.keep_going, "Write what can be decoded of a damaged or truncated stream");
  verb->add_flag("--quiet", a.quiet, "No progress bar");
  verb->callback([&] { run = [&] { return run_decode(a); }; });
}

void add_others(CLI::App& app, PlayArguments& play, EvaluateArguments& evaluate, InspectArguments& inspect,
                ExportArguments& table, Run& run) {
  CLI::App* verb =
      app.add_subcommand("play", "Show a stream in a window (space pauses, . steps, r again, q quits)");
  verb->add_option("INPUT", play.input, "The stream")->required();
  verb->callback([&] { run = [&] { return run_play(play); }; });

  verb = app.add_subcommand("evaluate", "Measure rate and distortion against the source");
  verb->add_option("SOURCE", evaluate.source, "The source video")->required();
  verb->add_option("STREAM", evaluate.stream,
                   "The stream to measure; without it the source is encoded first");
  verb->add_option("--quality", evaluate.qualities, "Qualities to encode with, one or several")
      ->capture_default_str()
      ->check(CLI::Range(0, 100))
      ->expected(1, 16);
  verb->add_flag("--json", evaluate.json, "Print JSON");
  verb->add_flag("--quiet", evaluate.quiet, "No progress bar");
  verb->callback([&] { run = [&] { return run_evaluate(evaluate); }; });

  verb = app.add_subcommand("inspect", "Show what is in a stream, bytes by part");
  verb->add_option("INPUT", inspect.input, "The stream")->required();
  verb->add_flag("--json", inspect.json, "Print JSON");
  verb->callback([&] { run = [&] { return run_inspect(inspect); }; });

  verb = app.add_subcommand("export", "Write pose and landmarks of every picture as a table");
  verb->add_option("INPUT", table.input, "The stream")->required();
  verb->add_option("OUTPUT", table.output, "The table, .csv")->required();
  verb->callback([&] { run = [&] { return run_export(table); }; });
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{kAbout, "fbs"};
  app.footer(kExamples);
  app.set_version_flag("--version", "fbs " FBS_VERSION);
  app.require_subcommand(1);
  Run run;
  EncodeArguments encode;
  DecodeArguments decode;
  PlayArguments play;
  EvaluateArguments evaluate;
  InspectArguments inspect;
  ExportArguments table;
  add_encode(app, encode, run);
  add_decode(app, decode, run);
  add_others(app, play, evaluate, inspect, table, run);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help, --version
    return app.exit(asked);
  } catch (const CLI::ParseError& wrong) {
    std::fprintf(stderr, "fbs: %s; see fbs --help\n", wrong.what());
    return kFailed;
  }
  const auto result = run();
  if (result) return 0;
  std::fprintf(stderr, "fbs: %s\n", result.error().text.c_str());
  return kFailed;
}
