// The options of `fbs export`.
#include <memory>

#include "cli/export/export_arguments.h"
#include "cli/verb.h"

namespace fbs::cli {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  fbs export talk.fbs talk.csv                    head pose and 68 landmarks of every picture";

}  // namespace

void add_export(CLI::App& app, Run& run) {
  const auto arguments = std::make_shared<ExportArguments>();
  ExportArguments& a = *arguments;
  CLI::App* verb = app.add_subcommand("export", "Write head pose and landmarks of every picture as a table");
  verb->add_option("INPUT", a.input, "Stream to export, or - for standard input")->required();
  verb->add_option("OUTPUT", a.output, "Table to write (.csv)")->required();
  verb->footer(kExamples);
  verb->callback([&run, arguments] { run = [arguments] { return run_export(*arguments); }; });
}

}  // namespace fbs::cli
