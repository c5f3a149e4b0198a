// fbs remux: puts a stream into a Matroska file, and takes it out.
#include <array>
#include <cstdio>

#include "cli/command_line/verb.h"
#include "cli/files/atomic_file.h"
#include "cli/files/output_check.h"
#include "cli/program/module.h"
#include "cli/stream/matroska_module.h"
#include "cli/stream/stream_file.h"
#include "decoder/stream/packet_list.h"

namespace fbs::cli {
namespace {

constexpr const char* kRemuxExamples =
    "Examples:\n"
    "  fbs remux talk.fbs talk.mkv                     Matroska, with the sound as a track of its own\n"
    "  fbs remux talk.mkv talk.fbs                     and back: the same bytes\n"
    "  fbs remux talk.mkv - | fbs decode - talk.y4m    through a pipe";

struct RemuxArguments {
  std::string input, output;
  bool quiet = false;
};

using Bytes = std::vector<std::uint8_t>;

bool is_matroska_name(const std::string& name) {
  return extension_of(name) == ".mkv";
}

Result<void> check_files(const RemuxArguments& a) {
  if (!is_matroska_name(a.output))
    if (auto named = check_stream_name(a.output); !named)
      return fail(ErrorCode::kUnsupported,
                  "cannot write " + a.output + ": remux writes a Matroska file (.mkv) or a stream (.fbs)");
  const std::array inputs{NamedFile{"INPUT", a.input}};
  const std::array outputs{NamedFile{"OUTPUT", a.output}};
  return check_distinct(inputs, outputs);
}

/// Notes on what may hinder using the file elsewhere.
void print_notes(const RemuxArguments& a, const StreamFile& file, const Bytes& stream,
                 const MatroskaFile* made) {
  const auto say = [&](const std::string& name, const std::string& text) {
    std::fprintf(stderr, "fbs: %s: %s\n", name.c_str(), text.c_str());
  };
  for (const std::string& codec : file.left_out()) say(file.name(), "a track of " + codec + " is left out");
  for (const PacketEntry& entry : list_packets(stream))
    if (!entry.error.empty()) {
      say(file.name(), "the stream is damaged, and is kept as it is");
      break;
    }
  if (made != nullptr && made->sound_inside)
    say(a.output, "the sound stays within the video track, where only fbs finds it");
}

Result<void> write(const std::string& name, const Bytes& bytes) {
  auto out = AtomicFile::create(name);
  if (!out) return fail(out.error());
  if (out->replaced_leftover()) print_replaced_leftover(name);
  if (auto written = out->write(bytes); !written) return written;
  return out->commit();
}

Result<MatroskaFile> to_matroska_file(const Bytes& stream) {
  const auto convert = load_module_function<StreamToMatroska>(kMatroskaModule, kStreamToMatroskaSymbol);
  if (!convert) return fail(convert.error());
  Result<MatroskaFile> file;
  (*convert)(stream, "fbs " FBS_VERSION, file);
  return file;
}

Result<void> put_in(const RemuxArguments& a, StreamFile& file, const Bytes& stream) {
  if (file.is_matroska())
    return fail(ErrorCode::kInvalidArgument,
                a.input + ": is a Matroska file already; OUTPUT may be a stream (.fbs)");
  const auto made = to_matroska_file(stream);
  if (!made) return fail(about_file(file.name(), made.error()));
  if (auto written = write(a.output, made->bytes); !written) return written;
  if (!a.quiet) print_notes(a, file, stream, &*made);
  return {};
}

Result<void> take_out(const RemuxArguments& a, StreamFile& file, const Bytes& stream) {
  if (!file.is_matroska())
    return fail(ErrorCode::kInvalidArgument,
                file.name() + ": is not a Matroska file; OUTPUT may be one (.mkv)");
  if (auto written = write(a.output, stream); !written) return written;
  if (!a.quiet) print_notes(a, file, stream, nullptr);
  return {};
}

Result<Outcome> run_remux(const RemuxArguments& arguments) {
  if (auto checked = check_files(arguments); !checked) return fail(checked.error());
  auto file = StreamFile::open(arguments.input);
  if (!file) return fail(file.error());
  const auto stream = file->read_all();
  if (!stream) return fail(stream.error());
  // On standard output, whichever the input is not.
  const bool puts_in =
      is_matroska_name(arguments.output) || (arguments.output == "-" && !file->is_matroska());
  const auto done = puts_in ? put_in(arguments, *file, *stream) : take_out(arguments, *file, *stream);
  return done.map([] { return Outcome::kComplete; });
}

}  // namespace

void add_remux(CLI::App& app, Run& run) {
  const auto [verb, a] = new_verb<RemuxArguments>(
      app, run, "remux", "Put a stream into a Matroska file, or take it out, without loss", run_remux);
  verb->add_option("INPUT", a.input, "Stream (.fbs, or - for standard input) or Matroska file (.mkv)")
      ->required();
  verb->add_option("OUTPUT", a.output,
                   "Matroska file (.mkv) or stream (.fbs), or - for standard output: whichever INPUT is not")
      ->required();
  verb->add_flag("--quiet", a.quiet, "Print nothing but errors");
  verb->footer(kRemuxExamples);
}

}  // namespace fbs::cli
