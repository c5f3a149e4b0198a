// The options of `fbs export`.

#include "cli/command_line/verb.h"
#include "cli/export/export_arguments.h"

namespace fbs::cli {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  fbs export talk.fbs head.glb                    animated head with texture and morph targets\n"
    "  fbs export talk.fbs head.gltf --draco           the same as text, its mesh compressed\n"
    "  fbs export talk.fbs frames/head_%05d.obj        a mesh for each picture\n"
    "  fbs export talk.fbs talk.csv                    pose, landmarks, gaze, expression of each picture\n"
    "  fbs export talk.fbs - --format json | jq '.frames[0].face.pose'";

}  // namespace

void add_export(CLI::App& app, Run& run) {
  const auto [verb, a] = new_verb<ExportArguments>(
      app, run, "export", "Write the head as a model, or its motion as a table", run_export);
  verb->add_option("INPUT", a.input, "Stream to export, or - for standard input")->required();
  verb->add_option(
          "OUTPUT", a.output,
          "Model (.glb, .gltf, or a sequence head_%05d.obj), table (.csv, .json), or - for a table on "
          "standard output")
      ->required();
  verb->add_option("--format", a.format, "Of a table on standard output (default: csv)")
      ->check(CLI::IsMember({"csv", "json"}))
      ->type_name("csv|json");
  verb->add_flag("--draco", a.draco, "Compress the mesh of a .glb or .gltf with Draco");
  verb->footer(kExamples);
}

}  // namespace fbs::cli
