// The program fbs: parses the command line and runs one verb.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "cli/command_line/help_formatter.h"
#include "cli/command_line/verb.h"
#include "cli/files/output_check.h"
#include "cli/program/report.h"

namespace {

constexpr int kFailed = 2;

constexpr const char* kAbout =
    "fbs, a video codec for talking heads: a few pictures of the person, and between them only motion.\n";

constexpr const char* kExamples =
    "Examples:\n"
    "  fbs encode talk.mkv talk.fbs                    print size, bitrate and PSNR when done\n"
    "  fbs encode talk.mkv talk.fbs --quality 70       higher quality, larger file\n"
    "  fbs encode talk.mkv talk.fbs --bitrate 5        aim for a total of 5 kbit/s\n"
    "  fbs encode talk.mkv talk.fbs --overlay see.mp4  also write a video of what was tracked\n"
    "  fbs decode talk.fbs talk.y4m                    or .mp4, .mkv, frame_%05d.png, - for a pipe\n"
    "  fbs decode talk.fbs - | mpv -                   pipe into a player\n"
    "  fbs decode talk.fbs part.mkv --from 90          begin at 1:30\n"
    "  fbs decode talk.fbs talk.wav                    the sound alone\n"
    "  fbs decode talk.fbs --md5                       compare decoders picture by picture\n"
    "  fbs play talk.fbs                               play in a window\n"
    "  fbs evaluate talk.mkv --quality 30 50 70        rate and distortion at three qualities\n"
    "  fbs inspect talk.fbs                            size of each part of the stream\n"
    "  fbs export talk.fbs head.glb                    animated head with texture and morph targets\n"
    "  fbs export talk.fbs talk.csv                    pose, landmarks and expression per picture\n"
    "  fbs track talk.mkv talk.csv                     the same of a video, without a stream\n"
    "  fbs retarget --motion a.fbs --face b.fbs c.fbs  b's face with a's motion\n"
    "  fbs remux talk.fbs talk.mkv                     into a Matroska file, and back, without loss\n"
    "  fbs doctor                                      versions and machine, for bug reports\n"
    "\n"
    "Run `fbs VERB --help` for the options of a verb.\n"
    "Exit code: 0 on success; 2 on failure, with one line on standard error; 3 or 4 when decode\n"
    "--keep-going has lost pictures; 3 when inspect --packets has found damage; 130 or 143 when stopped.";

/// What is wrong with the command line. Only the verb knows its options, and where to read about them.
std::string text_of(const CLI::ParseError& wrong, const CLI::App& app, int argc, char** argv) {
  const std::string see_all = "; see fbs --help";
  if (argc < 2) return "no verb" + see_all;
  const std::string first = argv[1];
  if (first.starts_with('-')) return "no option " + first + " before the verb" + see_all;
  const auto verbs = app.get_subcommands();
  if (verbs.empty()) return "no verb " + first + see_all;
  return std::string(wrong.what()) + "; see fbs " + verbs.front()->get_name() + " --help";
}

int end_with(const fbs::Error& error) {
  std::fprintf(stderr, "fbs: %s\n", error.text.c_str());
  fbs::report_error(error.code);
  return kFailed;
}

/// @return `code`, or kFailed when what was printed does not arrive
int end_output(int code) {
  const auto flushed = fbs::cli::flush_standard_output();
  if (flushed) return code;
  return end_with(flushed.error());
}

int run_program(int argc, char** argv) {
  CLI::App app{kAbout, "fbs"};
  app.formatter(std::make_shared<fbs::cli::HelpFormatter>());
  app.footer(kExamples);
  app.set_version_flag("--version", "fbs " FBS_VERSION);
  app.require_subcommand(1);
  fbs::cli::Run run;
  fbs::cli::add_encode(app, run);
  fbs::cli::add_decode(app, run);
  fbs::cli::add_play(app, run);
  fbs::cli::add_evaluate(app, run);
  fbs::cli::add_inspect(app, run);
  fbs::cli::add_export(app, run);
  fbs::cli::add_track(app, run);
  fbs::cli::add_retarget(app, run);
  fbs::cli::add_remux(app, run);
  fbs::cli::add_doctor(app, run);
  fbs::cli::add_completions(app, run);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help, --version
    return end_output(app.exit(asked));
  } catch (const CLI::ParseError& wrong) {
    return end_with({fbs::ErrorCode::kInvalidArgument, text_of(wrong, app, argc, argv)});
  }
  const auto result = run();
  if (result) return end_output(static_cast<int>(*result));
  return end_with(result.error());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const std::bad_alloc&) {
    std::fputs("fbs: out of memory\n", stderr);
    fbs::report_no_memory();
    return kFailed;
  } catch (const std::exception& problem) {
    return end_with({fbs::ErrorCode::kInternal, problem.what()});
  }
}
