// The program fbs: parses the command line and runs one verb.
#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "cli/standard_output.h"
#include "cli/verbs.h"

namespace {

using fbs::cli::DecodeArguments;
using fbs::cli::EncodeArguments;
using fbs::cli::EvaluateArguments;
using fbs::cli::ExportArguments;
using fbs::cli::InspectArguments;
using fbs::cli::Outcome;
using fbs::cli::PlayArguments;

constexpr int kFailed = 2;
constexpr std::int64_t kMaxFrames = 1'000'000'000;  // of --frames: more than a year
constexpr double kMaxSeconds = 1e8;                 // of --duration and --from: three years

constexpr const char* kAbout =
    "fbs, a video codec for talking heads. It sends a picture of the person once, then only the motion.\n";

constexpr const char* kExamples =
    "Examples:\n"
    "  fbs encode talk.mkv talk.fbs                    print size, bitrate and PSNR when done\n"
    "  fbs encode talk.mkv talk.fbs --quality 70       higher quality, larger file\n"
    "  fbs encode talk.mkv talk.fbs --bitrate 5        aim for a total of 5 kbit/s\n"
    "  fbs encode talk.mkv talk.fbs --overlay see.mp4  also write a video of what was tracked\n"
    "  fbs decode talk.fbs talk.y4m                    or .mp4, .mkv, frame_%05d.png, - for a pipe\n"
    "  fbs decode talk.fbs - | mpv -                   pipe into a player\n"
    "  fbs decode talk.fbs part.mkv --from 90          begin at 1:30\n"
    "  fbs decode talk.fbs --md5                       compare decoders picture by picture\n"
    "  fbs play talk.fbs                               play in a window\n"
    "  fbs evaluate talk.mkv --quality 30 50 70        rate and distortion at three qualities\n"
    "  fbs inspect talk.fbs                            size of each part of the stream\n"
    "  fbs export talk.fbs talk.csv                    head pose and 68 landmarks per picture\n"
    "\n"
    "Run `fbs VERB --help` for the options of a verb.\n"
    "Exit code: 0 on success; 2 on failure, with one line on standard error; 3 or 4 when decode "
    "--keep-going\n"
    "has lost pictures; 3 when inspect --packets has found damage; 130 or 143 when stopped.";

constexpr const char* kHiddenGroup = "for measurements";

/// Leaves out the hidden options. CLI11's own way, an empty group, would also leave their names out of
/// errors.
class HidingFormatter : public CLI::Formatter {
 public:
  [[nodiscard]] std::string make_group(std::string group, bool is_positional,
                                       std::vector<const CLI::Option*> options) const override {
    return group == kHiddenGroup ? "" : Formatter::make_group(group, is_positional, options);
  }
};

using Run = std::function<fbs::Result<Outcome>()>;

fbs::Result<Outcome> complete(const fbs::Result<void>& result) {
  return result.map([] { return Outcome::kComplete; });
}

/// CLI::Range lets NaN through.
CLI::Validator number_within(double low, double high) {
  std::array<char, 64> range{};
  std::snprintf(range.data(), range.size(), "[%g - %g]", low, high);
  const auto check = [low, high](const std::string& text) -> std::string {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (end != text.c_str() && *end == '\0' && value >= low && value <= high) return {};
    std::array<char, 64> limits{};
    std::snprintf(limits.data(), limits.size(), " not in range %g to %g", low, high);
    return "Value " + text + limits.data();
  };
  return {check, std::string("FLOAT in ") + range.data()};
}

void add_from(CLI::App& verb, double& from) {
  verb.add_option("--from", from, "Begin with the picture of this time")
      ->check(number_within(0, kMaxSeconds))
      ->type_name("SECONDS");
}

/// Options that decide what is sent, and when.
void add_encode_rate(CLI::App& verb, EncodeArguments& a) {
  verb.add_option("--quality", a.quality, "From 0 (smallest file) to 100 (best pictures)")
      ->capture_default_str()
      ->check(CLI::Range(0, 100));
  verb.add_option("--bitrate", a.bitrate, "Target total bitrate in kbit/s, instead of a quality")
      ->check(number_within(0.1, 10000))
      ->excludes("--quality");
  verb.add_option("--patterns", a.patterns,
                  "Number of patterns, in a long video of each two minutes or so; 1 sends one picture and "
                  "then only motion (default: chosen by the encoder)")
      ->check(CLI::Range(1, 64));
  verb.add_flag("--live,!--no-live", a.live,
                "Encode pictures as they come, without look-ahead; the default for a camera. Costs bits: a "
                "file is better encoded without");
  verb.add_option("--delay", a.delay, "With --live: seconds of pictures that are encoded together")
      ->capture_default_str()
      ->check(number_within(0.01, 5));
  verb.add_option(
          "--buffer", a.buffer,
          "With --live and --bitrate: no picture arrives later than so many seconds over a channel of "
          "that rate")
      ->capture_default_str()
      ->check(number_within(0.1, 60));
  verb.add_option(
          "--threads", a.threads,
          "With --live: with 2 or more, pictures are encoded while the next ones are analysed (default: "
          "one for each core)")
      ->check(CLI::Range(1, 64));
  verb.add_option("--key-interval", a.key_interval,
                  "Most seconds between the places where a viewer can join and damage ends (default: up to "
                  "40 with several patterns; none with --patterns 1; 10 with --live)")
      ->check(CLI::Range(0.2, 3600.0));
}

/// Options that leave out a part of the encoder, to measure what it brings.
void add_experiments(CLI::App& verb, EncodeArguments& a) {
  verb.add_flag_callback("--reduced-patterns", [&a] { a.reduced_patterns = true; })->group(kHiddenGroup);
  verb.add_flag_callback("--full-size-patterns", [&a] { a.reduced_patterns = false; })->group(kHiddenGroup);
  verb.add_flag("!--no-snakes", a.snakes)->group(kHiddenGroup);
  verb.add_flag("!--no-refine", a.refine)->group(kHiddenGroup);
  verb.add_flag("!--no-landmarks", a.landmarks)->group(kHiddenGroup);
  verb.add_flag("!--still-surround", a.surround)->group(kHiddenGroup);
  verb.add_option("--pattern-quantiser", a.pattern_quantiser)->check(CLI::Range(0, 63))->group(kHiddenGroup);
  verb.add_option("--motion-bitrate", a.motion_bitrate)
      ->check(number_within(0.05, 1000))
      ->group(kHiddenGroup);
}

void add_encode(CLI::App& app, EncodeArguments& a, Run& run) {
  CLI::App* verb = app.add_subcommand("encode", "Encode a video");
  verb->add_option("INPUT", a.input,
                   "Video file, - (Y4M on standard input), camera:0, or images (frame_%05d.png or a folder)")
      ->required();
  verb->add_option("OUTPUT", a.output, "Stream to write (.fbs)")->required();
  add_encode_rate(*verb, a);
  verb->add_option("--effort", a.effort,
                   "0 is fastest; 1 optimises patterns and motion for each other; 2 does so once more, for "
                   "1 % fewer bytes at equal quality")
      ->capture_default_str()
      ->check(CLI::Range(0, 2));
  verb->add_option(
      "--marks", a.marks,
      "JSON file with the positions of facial points in the first picture, {\"nose_tip\": [x, y], "
      "...} or {\"landmarks\": [68 points]}; detected automatically if not given");
  verb->add_option("--face", a.face, "Face to track; 0 is the largest")
      ->capture_default_str()
      ->check(CLI::Range(0, 99));
  verb->add_option("--overlay", a.overlay,
                   "Also write a video of the source with mesh and snakes drawn on it (.mp4, .mkv, .y4m)");
  verb->add_option("--frames", a.frames, "Encode the first N pictures only")
      ->check(CLI::Range(std::int64_t{1}, kMaxFrames))
      ->type_name("N");
  verb->add_option("--duration", a.duration,
                   "Encode the first SECONDS only; with --frames, whichever ends first")
      ->check(number_within(0.001, kMaxSeconds))
      ->type_name("SECONDS");
  verb->add_option("--rate", a.sequence_rate, "Pictures per second, for image sequences")
      ->capture_default_str()
      ->check(number_within(0.01, 1000));
  verb->add_flag("--allow-no-face", a.allow_no_face,
                 "Encode a video without a face, too, instead of failing");
  verb->add_flag("--quiet", a.quiet, "Print no progress bar and no summary, and measure no PSNR");
  add_experiments(*verb, a);
  verb->callback([&] { run = [&] { return run_encode(a); }; });
}

void add_decode(CLI::App& app, DecodeArguments& a, Run& run) {
  CLI::App* verb = app.add_subcommand("decode", "Decode a stream");
  verb->add_option("INPUT", a.input, "Stream to decode, or - for standard input")->required();
  verb->add_option("OUTPUT", a.output,
                   ".y4m, - (Y4M on standard output), .mp4, .mkv, frame_%05d.png, or null: to discard");
  verb->add_flag("--md5", a.md5,
                 "Print the MD5 of the planes Y, U, V of each picture, a line each; OUTPUT may be left out");
  verb->add_option("--sound", a.sound, "Copy the sound of this file into the output (.mp4, .mkv)");
  verb->add_flag(
      "--vfr", a.vfr,
      "Y4M: write each picture once; without it pictures are repeated or dropped where the frame rate "
      "varies, to keep the speed");
  add_from(*verb, a.from);
  verb->add_option("--threads", a.threads,
                   "Threads that draw each picture (default: one for each core, up to four)")
      ->check(CLI::Range(1, 64));
  verb->add_flag(
      "--keep-going", a.keep_going,
      "Write all that can be decoded of a damaged or cut stream, and repeat pictures in the place of "
      "lost ones; exit code 0: nothing lost; 3: less than a tenth of the pictures, or only the end "
      "is missing; 4: more");
  verb->add_flag("--quiet", a.quiet, "Print no progress bar");
  verb->callback([&] { run = [&] { return run_decode(a); }; });
}

void add_others(CLI::App& app, PlayArguments& play, EvaluateArguments& evaluate, InspectArguments& inspect,
                ExportArguments& table, Run& run) {
  CLI::App* verb = app.add_subcommand(
      "play", "Play a stream in a window (space: pause, .: step, p: patterns, r: restart, q: quit)");
  verb->add_option("INPUT", play.input, "Stream to play")->required();
  add_from(*verb, play.from);
  verb->callback([&] { run = [&] { return complete(run_play(play)); }; });

  verb = app.add_subcommand("evaluate", "Measure rate and distortion against the source");
  verb->add_option("SOURCE", evaluate.source, "Source video")->required();
  verb->add_option("STREAM", evaluate.stream, "Stream to measure; if not given, the source is encoded first");
  verb->add_option("--quality", evaluate.qualities, "One or more qualities to encode with")
      ->capture_default_str()
      ->check(CLI::Range(0, 100))
      ->expected(1, 16);
  verb->add_flag("--live", evaluate.live, "Encode as live pictures are");
  verb->add_flag("--allow-no-face", evaluate.allow_no_face,
                 "Measure a video without a face instead of failing");
  verb->add_flag("--json", evaluate.json, "Print JSON");
  verb->add_flag("--quiet", evaluate.quiet, "Print no progress bar");
  verb->callback([&] { run = [&] { return run_evaluate(evaluate); }; });

  verb = app.add_subcommand("inspect", "Show what a stream contains and the size of each part");
  verb->add_option("INPUT", inspect.input, "Stream to inspect, or - for standard input")->required();
  verb->add_flag("--packets", inspect.packets,
                 "List every packet, also of a damaged stream: place, type, time of the first picture that "
                 "it concerns, bytes, and what is wrong; exit code 3: something is");
  verb->add_flag("--json", inspect.json, "Print JSON");
  verb->callback([&] { run = [&] { return run_inspect(inspect); }; });

  verb = app.add_subcommand("export", "Write head pose and landmarks of every picture as a table");
  verb->add_option("INPUT", table.input, "Stream to export, or - for standard input")->required();
  verb->add_option("OUTPUT", table.output, "Table to write (.csv)")->required();
  verb->callback([&] { run = [&] { return complete(run_export(table)); }; });
}

/// @return `code`, or kFailed when what was printed does not arrive
int end_output(int code) {
  const auto flushed = fbs::cli::flush_standard_output();
  if (flushed) return code;
  std::fprintf(stderr, "fbs: %s\n", flushed.error().text.c_str());
  return kFailed;
}

int run_program(int argc, char** argv) {
  CLI::App app{kAbout, "fbs"};
  app.formatter(std::make_shared<HidingFormatter>());
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
    return end_output(app.exit(asked));
  } catch (const CLI::ParseError& wrong) {
    std::fprintf(stderr, "fbs: %s; see fbs --help\n", wrong.what());
    return kFailed;
  }
  const auto result = run();
  if (result) return end_output(static_cast<int>(*result));
  std::fprintf(stderr, "fbs: %s\n", result.error().text.c_str());
  return kFailed;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const std::exception& problem) {  // out of memory, say
    std::fprintf(stderr, "fbs: %s\n", problem.what());
    return kFailed;
  }
}
