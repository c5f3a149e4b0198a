// fbs retarget: one face with the motion of another.
#include <algorithm>
#include <array>
#include <cstdio>
#include <span>
#include <utility>
#include <vector>

#include "cli/export/model_module.h"
#include "cli/files/atomic_file.h"
#include "cli/files/output_check.h"
#include "cli/program/module.h"
#include "cli/program/outcome.h"
#include "cli/source/encode_session.h"
#include "cli/source/encoder_module.h"
#include "cli/source/source_part.h"
#include "cli/stream/sound_interleaver.h"
#include "cli/stream/stream_file.h"
#include "cli/video/open/open_video.h"
#include "decoder/sound/sound_parts.h"
#include "encoder/retarget/retarget.h"
#include "encoder/retarget/wire_frame_fit.h"

namespace fbs::cli {
namespace {

using Bytes = std::vector<std::uint8_t>;

Result<Bytes> read_stream(const std::string& name) {
  auto file = StreamFile::open(name);
  if (!file) return fail(file.error());
  return file->read_all();
}

/// A stream of the picture alone.
Result<Bytes> encode_picture(const RetargetArguments& arguments) {
  auto opened = open_video_source(arguments.face);
  if (!opened) return fail(opened.error());
  SourcePart source(std::move(*opened), {1, std::nullopt}, nullptr);
  EncoderSettings settings;
  settings.quality = arguments.quality.value_or(kPictureQuality);
  settings.patterns = 1;
  Bytes stream;
  const auto take = [&](std::span<const std::uint8_t> bytes) -> Result<void> {
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    return {};
  };
  auto encoded = encode_source(source, settings, take, {}, Measured::kRate, true);
  if (!encoded) return fail(about_file(arguments.face, encoded.error()));
  return stream;
}

Result<std::shared_ptr<const WireFrame>> read_wire_frame(const std::string& name) {
  const auto read = load_module_function<ReadWireFrameFunction>(kModelModule, kReadWireFrameSymbol);
  if (!read) return fail(read.error());
  Result<std::shared_ptr<const WireFrame>> frame;
  (*read)(name, frame);
  return frame;
}

Result<FaceStream> read_face(const RetargetArguments& arguments) {
  const bool is_stream = is_stream_file(arguments.face);
  if (is_stream && arguments.quality)
    return fail(ErrorCode::kInvalidArgument,
                "--quality is for a picture: " + arguments.face + " is a stream, whose patterns are copied");
  const auto bytes = is_stream ? read_stream(arguments.face) : encode_picture(arguments);
  if (!bytes) return fail(bytes.error());
  auto face = read_face_stream(*bytes);
  if (!face) return fail(about_file(arguments.face, face.error()));
  if (arguments.wire_frame.empty()) return face;
  auto frame = read_wire_frame(arguments.wire_frame);
  if (!frame) return fail(about_file(arguments.wire_frame, frame.error()));
  return on_wire_frame(std::move(*face), std::move(*frame));
}

/// Adds the sound of the motion, whose times the result has. Frames are copied.
Result<Bytes> with_sound(Bytes stream, std::span<const std::uint8_t> motion) {
  SoundParts sound;
  sound.add(motion);
  if (sound.all().empty()) return stream;
  const SoundSetup setup = sound.all().front().setup;
  auto next = sound.all().begin();
  const auto groups_before = [&](std::int64_t time) -> Result<std::vector<SoundGroup>> {
    std::vector<SoundGroup> groups;
    for (; next != sound.all().end() && begin_of(*next) < time; ++next)
      if (next->setup == setup) groups.push_back(next->group);  // a stream has one codec
    return groups;
  };
  return SoundInterleaver(setup, groups_before).add(stream);
}

Result<void> check_files(const RetargetArguments& a) {
  if (auto named = check_stream_name(a.output); !named) return named;
  std::vector<NamedFile> inputs{{"--motion", a.motion}, {"--face", a.face}};
  if (!a.wire_frame.empty()) inputs.push_back({"--wire-frame", a.wire_frame});
  const std::array outputs{NamedFile{"OUTPUT", a.output}};
  return check_distinct(inputs, outputs);
}

Result<Outcome> retarget_files(const RetargetArguments& arguments) {
  if (auto checked = check_files(arguments); !checked) return fail(checked.error());
  const auto moving = read_stream(arguments.motion);
  if (!moving) return fail(moving.error());
  const auto motion = read_motion_record(*moving);
  if (!motion) return fail(about_file(arguments.motion, motion.error()));
  const auto face = read_face(arguments);
  if (!face) return fail(face.error());
  auto stream = retarget(*motion, *face);
  if (stream && !arguments.no_sound) stream = with_sound(std::move(*stream), *moving);
  if (!stream) return fail(about_file(arguments.output, stream.error()));

  auto out = AtomicFile::create(arguments.output);
  if (!out) return fail(out.error());
  if (out->replaced_leftover()) print_replaced_leftover(arguments.output);
  if (auto written = out->write(*stream); !written) return fail(written.error());
  if (auto committed = out->commit(); !committed) return fail(committed.error());
  if (!arguments.quiet)
    std::fprintf(stderr, "%s: %zu pictures, %zu bytes, %zu pattern%s\n", arguments.output.c_str(),
                 motion->pictures.size(), stream->size(), face->later.size() + 1,
                 face->later.empty() ? "" : "s");
  return Outcome::kComplete;
}

}  // namespace
}  // namespace fbs::cli

FBS_MODULE_EXPORT void fbs_run_retarget(const fbs::cli::RetargetArguments& arguments,
                                        fbs::Result<fbs::cli::Outcome>& result) {
  result = fbs::cli::retarget_files(arguments);
}
