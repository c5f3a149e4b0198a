// The options of `fbs evaluate`.
#include <cstdint>

#include "cli/command_line/verb.h"
#include "cli/source/encoder_module.h"

namespace fbs::cli {
namespace {

constexpr const char* kEvaluateExamples =
    "Examples:\n"
    "  fbs evaluate talk.mkv                           encode at five qualities, compare with the source\n"
    "  fbs evaluate talk.mkv talk.fbs                  measure a stream\n"
    "  fbs evaluate talk.mkv a.fbs b.fbs               compare two streams, with the face of the first\n"
    "  fbs evaluate talk.mkv --quality 30 50 70        choose the qualities\n"
    "  fbs evaluate talk.mkv --peers --html talk.html  draw curves beside x264, x265 and AV1\n"
    "  fbs evaluate talk.mkv --live --bitrate 6 12     what a call shows over such links\n"
    "  fbs evaluate clips/ --peers --html all.html     a folder of videos, in one report\n"
    "  fbs evaluate talk.mkv --json talk.json --csv -  JSON in a file, values of each picture printed\n"
    "\n"
    "Repeat an interrupted command with --html or --keep to go on where it stopped.";

void add_peers(CLI::App& verb, EvaluateArguments& a) {
  verb.add_flag("--peers", a.peers, "Also encode with x264, x265 and AV1, through ffmpeg; takes minutes");
  verb.add_option("--peer-codec", a.peer_codecs, "Only these of x264, x265, av1")
      ->check(CLI::IsMember({"x264", "x265", "av1"}))
      ->type_name("x264|x265|av1")
      ->expected(1, 3)
      ->needs("--peers");
  verb.add_option("--peer-size", a.peer_sizes,
                  "Only at the full size (1), half of it (2), a quarter (4; pictures of more than 400x400)")
      ->check(CLI::IsMember({1, 2, 4}))
      ->type_name("1|2|4")
      ->expected(1, 3)
      ->needs("--peers");
  verb.add_option("--peer-rate", a.peer_rates,
                  "Only with all pictures (1), every second (2), every third (3)")
      ->check(CLI::Range(1, 3))
      ->expected(1, 3)
      ->needs("--peers");
}

}  // namespace

void add_evaluate(CLI::App& app, Run& run) {
  const auto [verb, a] =
      new_verb<EvaluateArguments>(app, run, "evaluate", "Measure rate and distortion against the source",
                                  in_module(kEncoderModule, kEvaluateSymbol));
  verb->add_option("SOURCE", a.source, "Source video, or a folder of videos")->required();
  verb->add_option("STREAM", a.streams, "Streams to measure; if none is given, the source is encoded first");
  verb->add_option("--quality", a.qualities, "One or more qualities to encode with (default: 20 35 50 65 80)")
      ->check(CLI::Range(0, 100))
      ->expected(1, 16);
  verb->add_option("--bitrate", a.bitrates, "Total bitrates in kbit/s to encode with, instead of qualities")
      ->check(number_within(0.1, 10000))
      ->expected(1, 16)
      ->excludes("--quality");
  verb->add_flag("--live", a.live, "Encode as live pictures are; --peers is AV1 in real time, then");
  verb->add_flag("--allow-no-face", a.allow_no_face, "Measure a video without a face instead of failing");
  add_rotate(*verb, a.rotate);
  verb->add_option("--frames", a.frames, "Encode and measure the first N pictures only")
      ->check(CLI::Range(std::int64_t{1}, kMaxFrames))
      ->type_name("N");
  add_peers(*verb, a);
  verb->add_option(
          "--region", a.region,
          "Table of 68 landmarks (see export) or stream whose mesh says where the face is, instead of the "
          "streams that are measured")
      ->type_name("FILE");
  verb->add_option("--html", a.html, "Write a report with curves and pictures, or - for standard output")
      ->type_name("FILE");
  verb->add_option("--csv", a.csv, "Write the values of each picture, or - for standard output")
      ->type_name("FILE");
  verb->add_option("--stills", a.stills,
                   "Folder for JPEG files of a typical picture and of the worst: source, streams, difference")
      ->type_name("DIR");
  verb->add_option("--keep", a.keep,
                   "Folder for what is finished (default: NAME.fbs-run beside --html NAME.html)")
      ->type_name("DIR");
  verb->add_option("--jobs", a.jobs, "Videos of a folder to evaluate at the same time (default: 1)")
      ->check(CLI::Range(1, 64));
  verb->add_option_function<std::string>(
          "--json", [&json = a.json](const std::string& file) { json = file.empty() ? "-" : file; },
          "Write the results as JSON, on standard output unless a file (.json) is named")
      ->expected(0, 1)
      ->type_name("[FILE]");
  verb->add_flag("--quiet", a.quiet, "Print no progress");
  verb->footer(kEvaluateExamples);
}

}  // namespace fbs::cli
