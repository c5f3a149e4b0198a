// The options of `fbs evaluate`.
#include <memory>

#include "cli/encode/encode_arguments.h"
#include "cli/evaluate/evaluate_arguments.h"
#include "cli/module_verb.h"
#include "cli/verb.h"

namespace fbs::cli {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  fbs evaluate talk.mkv                           encode, then compare with the source\n"
    "  fbs evaluate talk.mkv talk.fbs                  measure a stream\n"
    "  fbs evaluate talk.mkv --quality 30 50 70        rate and distortion at three qualities";

}  // namespace

void add_evaluate(CLI::App& app, Run& run) {
  const auto arguments = std::make_shared<EvaluateArguments>();
  EvaluateArguments& a = *arguments;
  CLI::App* verb = app.add_subcommand("evaluate", "Measure rate and distortion against the source");
  verb->add_option("SOURCE", a.source, "Source video")->required();
  verb->add_option("STREAM", a.stream, "Stream to measure; if not given, the source is encoded first");
  verb->add_option("--quality", a.qualities, "One or more qualities to encode with")
      ->capture_default_str()
      ->check(CLI::Range(0, 100))
      ->expected(1, 16);
  verb->add_flag("--live", a.live, "Encode as live pictures are");
  verb->add_flag("--allow-no-face", a.allow_no_face, "Measure a video without a face instead of failing");
  verb->add_flag("--json", a.json, "Print JSON");
  verb->add_flag("--quiet", a.quiet, "Print no progress bar");
  verb->footer(kExamples);
  verb->callback([&run, arguments] {
    run = [arguments] { return run_in_module<Outcome>(kEncoderModule, kEvaluateSymbol, *arguments); };
  });
}

}  // namespace fbs::cli
