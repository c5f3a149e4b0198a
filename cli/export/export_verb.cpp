// fbs export: the heads of a stream as models, or their motion as a table.
#include <array>
#include <cstdio>

#include "cli/command_line/verb.h"
#include "cli/export/head_looks.h"
#include "cli/export/model_module.h"
#include "cli/export/obj_sequence.h"
#include "cli/export/table_output.h"
#include "cli/files/atomic_file.h"
#include "cli/files/output_check.h"
#include "cli/program/module.h"
#include "cli/stream/stream_file.h"
#include "decoder/scene/scene_face.h"

namespace fbs::cli {
namespace {

constexpr const char* kExportExamples =
    "Examples:\n"
    "  fbs export talk.fbs head.glb                    animated head with texture and morph targets\n"
    "  fbs export talk.fbs head.gltf --draco           the same as text, its mesh compressed\n"
    "  fbs export talk.fbs frames/head_%05d.obj        a mesh for each picture\n"
    "  fbs export talk.fbs talk.csv                    pose, landmarks, gaze, expression of each picture\n"
    "  fbs export talk.fbs - --format json | jq '.frames[0].face.pose'";

struct ExportArguments {
  std::string input, output;
  std::string format;  ///< "csv", "json", "glb", "gltf"; empty: by the name of the output
  bool draco = false;  ///< of a .glb or .gltf
};

enum class OutputKind : std::uint8_t { kTable, kGlb, kGltf, kObj };

struct Output {
  OutputKind kind = OutputKind::kTable;
  TableFormat table = TableFormat::kCsv;  ///< of a table
};

Result<OutputKind> model_kind(const std::string& name) {
  if (name.ends_with(".glb")) return OutputKind::kGlb;
  if (name.ends_with(".gltf")) return OutputKind::kGltf;
  if (name.ends_with(".obj")) return OutputKind::kObj;
  return fail(ErrorCode::kUnsupported, name + ": unknown format; use .glb, .gltf, .obj, .csv or .json");
}

/// --format of a model on standard output, or of one whose name says so anyway.
std::optional<OutputKind> asked_model(const ExportArguments& a) {
  if (a.output != "-" && extension_of(a.output) != "." + a.format) return std::nullopt;
  if (a.format == "glb") return OutputKind::kGlb;
  if (a.format == "gltf") return OutputKind::kGltf;
  return std::nullopt;
}

Result<Output> output_of(const ExportArguments& a) {
  if (const auto model = asked_model(a)) return Output{*model, {}};
  const auto table = table_format(a.output, a.format);
  if (!table) return fail(table.error());
  Output out;
  if (*table) {
    out.table = **table;
  } else if (const auto kind = model_kind(a.output)) {
    out.kind = *kind;
  } else {
    return fail(kind.error());
  }
  if (a.draco && out.kind != OutputKind::kGlb && out.kind != OutputKind::kGltf)
    return fail(ErrorCode::kInvalidArgument,
                "--draco needs an OUTPUT that ends in .glb or .gltf, or --format");
  return out;
}

/// Calls `take(decoder)` for every picture.
template <class Take>
Result<void> for_each_picture(StreamFile& file, const Take& take) {
  for (;;) {
    const auto status = file.next();
    if (!status) return fail(status.error());
    if (*status == DecodeStatus::kEnd) return {};
    if (Result<void> taken = take(file.decoder()); !taken) return taken;
  }
}

/// A stream does not say how sure its encoder was, so every face is believed.
FaceRow row_of(const StreamDecoder& decoder, FaceMeasure& measure) {
  FaceRow row;
  row.frame = decoder.position().pictures - decoder.start().pictures;
  row.seconds = static_cast<double>(decoder.position().time - decoder.start().time) / kTicksPerSecond;
  const SceneGeometry* face = face_of(decoder.scene());
  if (face == nullptr) return row;
  row.success = !decoder.held();
  row.confidence = row.success ? 1 : 0;
  row.face = measure(face->geometry(), decoder.state());
  return row;
}

Result<void> export_table(StreamFile& file, const ExportArguments& a, TableFormat format) {
  auto out = TableOutput::create(a.output, format);
  if (!out) return fail(out.error());
  FaceMeasure measure;
  bool begun = false;
  auto written = for_each_picture(file, [&](const StreamDecoder& decoder) {
    if (!begun)
      if (auto head = out->begin(decoder.format()); !head) return head;
    begun = true;
    return out->add(row_of(decoder, measure));
  });
  if (!written) return written;
  if (!begun)
    if (auto head = out->begin(file.decoder().format()); !head) return head;
  return out->finish();
}

Result<HeadRecording> record(StreamFile& file) {
  HeadRecording recording;
  auto read = for_each_picture(file, [&](const StreamDecoder& decoder) -> Result<void> {
    recording.add(decoder.scene(), decoder.state(), decoder.position().time, decoder.duration());
    return {};
  });
  if (!read) return fail(read.error());
  if (recording.heads().empty())
    return fail(ErrorCode::kNoFace, file.name() + ": no face in any picture: there is no head to export");
  return recording;
}

/// Notes on what a user may not expect of the model.
void print_notes(const std::string& output, const HeadRecording& recording) {
  const std::size_t heads = recording.heads().size();
  if (heads > 1)
    std::fprintf(stderr, "%s: %zu heads, each shown while the stream shows it\n", output.c_str(), heads);
  else if (recording.shown().size() > 1)
    std::fprintf(stderr, "%s: the head is hidden while the stream shows none\n", output.c_str());
}

Result<void> export_gltf(const HeadRecording& recording, const ExportArguments& a, bool binary) {
  const auto looks = make_head_looks(recording);
  if (!looks) return fail(looks.error());
  const auto write = load_module_function<WriteGltfFunction>(kModelModule, kWriteGltfSymbol);
  if (!write) return fail(write.error());
  Result<std::vector<std::uint8_t>> model;
  (*write)(recording, *looks, {binary, a.draco}, model);
  if (!model) return fail(model.error());
  auto out = AtomicFile::create(a.output);
  if (!out) return fail(out.error());
  if (out->replaced_leftover()) print_replaced_leftover(a.output);
  if (auto written = out->write(*model); !written) return written;
  return out->commit();
}

Result<void> export_model(StreamFile& file, const ExportArguments& a, OutputKind kind) {
  std::optional<NumberPattern> pattern;
  if (kind == OutputKind::kObj) {
    auto parsed = obj_pattern(a.output);
    if (!parsed) return fail(parsed.error());
    pattern = std::move(*parsed);
  }
  const auto recording = record(file);
  if (!recording) return fail(recording.error());
  auto written = pattern ? write_obj_sequence(*recording, *pattern)
                         : export_gltf(*recording, a, kind == OutputKind::kGlb);
  if (written) print_notes(a.output, *recording);
  return written;
}

Result<Outcome> run_export(const ExportArguments& arguments) {
  const auto output = output_of(arguments);
  if (!output) return fail(output.error());
  const std::array inputs{NamedFile{"INPUT", arguments.input}};
  const std::array outputs{NamedFile{"OUTPUT", arguments.output}};
  if (auto checked = check_distinct(inputs, outputs); !checked) return fail(checked.error());
  auto file = StreamFile::open(arguments.input);
  if (!file) return fail(file.error());
  auto done = output->kind == OutputKind::kTable ? export_table(*file, arguments, output->table)
                                                 : export_model(*file, arguments, output->kind);
  return done.map([] { return Outcome::kComplete; });
}

}  // namespace

void add_export(CLI::App& app, Run& run) {
  const auto [verb, a] = new_verb<ExportArguments>(
      app, run, "export", "Write the head as a model, or its motion as a table", run_export);
  verb->add_option("INPUT", a.input, "Stream to export, or - for standard input")->required();
  verb->add_option(
          "OUTPUT", a.output,
          "Model (.glb, .gltf, or a sequence head_%05d.obj), table (.csv, .json), or - for standard output")
      ->required();
  verb->add_option("--format", a.format, "On standard output (default: csv)")
      ->check(CLI::IsMember({"csv", "json", "glb", "gltf"}))
      ->type_name("csv|json|glb|gltf");
  verb->add_flag("--draco", a.draco, "Compress the mesh of a .glb or .gltf with Draco");
  verb->footer(kExportExamples);
}

}  // namespace fbs::cli
