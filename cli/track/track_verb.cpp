// fbs track: the encoder's analysis of a video as a table.
#include <array>
#include <cstdio>

#include "cli/export/table_output.h"
#include "cli/files/output_check.h"
#include "cli/program/module.h"
#include "cli/program/outcome.h"
#include "cli/program/progress.h"
#include "cli/source/encode_session.h"
#include "cli/source/encoder_module.h"
#include "cli/source/source_part.h"
#include "cli/source/until_stopped.h"
#include "cli/stream/stream_file.h"
#include "encoder/encoder.h"

namespace fbs::cli {
namespace {

constexpr const char* kFinishingTable = "fbs: finishing the table; a second signal ends at once";

/// The analysis compares pictures with the first pattern as decoded. A pattern nearly equal to the source
/// costs nothing here, since no stream is kept.
constexpr int kQuality = 100;

/// One pattern: the encoder then codes each second's motion, which is little work, and forgets it.
Result<EncoderSettings> settings_of(const TrackArguments& arguments) {
  EncoderSettings settings;
  settings.quality = kQuality;
  settings.patterns = 1;
  settings.effort = 0;
  settings.surround = false;
  settings.face = arguments.face;
  if (!arguments.marks.empty()) {
    auto marks = read_marks(arguments.marks);
    if (!marks) return fail(about_file(arguments.marks, marks.error()));
    settings.marks = *marks;
  }
  return settings;
}

FaceRow row_of(const PictureAnalysis& analysis, FaceMeasure& measure) {
  FaceRow row;
  if (!analysis.face) return row;
  row.success = analysis.followed;
  row.confidence = analysis.confidence;
  row.face = measure(analysis.geometry, analysis.state);
  return row;
}

/// Analyses pictures and writes their rows.
class Tracker {
 public:
  Tracker(Encoder encoder, TableOutput& out) : encoder_(std::move(encoder)), out_(out) {}

  Result<void> add(const TimedPicture& picture) {
    if (auto pushed = encoder_.push(picture.picture); !pushed) return pushed;
    static_cast<void>(encoder_.take());
    if (pictures_ == 0) first_pts_ = picture.pts;
    FaceRow row = row_of(encoder_.analysis(), measure_);
    row.frame = pictures_++;
    row.seconds = static_cast<double>(picture.pts - first_pts_) / kTicksPerSecond;
    return out_.add(row);
  }

  [[nodiscard]] int turn_to_upright() const { return encoder_.turn_to_upright(); }

  /// @return kNoFace when no picture showed a face
  Result<void> finish() { return encoder_.finish(); }

  [[nodiscard]] std::uint64_t pictures() const { return pictures_; }

 private:
  Encoder encoder_;
  TableOutput& out_;
  FaceMeasure measure_;
  std::uint64_t pictures_ = 0;
  std::int64_t first_pts_ = 0;  ///< 1/90000 s
};

Result<void> track_all(SourcePart& source, Tracker& tracker, bool quiet) {
  Progress progress("tracking", source.frame_count_estimate(), quiet);
  bool warned = quiet;
  for (std::int64_t done = 0;;) {
    const auto picture = source.next();
    if (!picture) return fail(picture.error());
    if (!*picture) return tracker.finish();
    if (auto added = tracker.add(**picture); !added) return added;
    if (!warned && tracker.turn_to_upright() != 0) {
      warned = true;
      progress.clear();
      print_turn_warning(tracker.turn_to_upright());
    }
    progress.update(++done);
  }
}

Result<TableFormat> check(const TrackArguments& a) {
  const auto format = table_format(a.output, a.format);
  if (!format) return fail(format.error());
  if (!*format) return fail(ErrorCode::kUnsupported, a.output + ": unknown format; use .csv, .json or -");
  const std::array inputs{NamedFile{"INPUT", a.input}, NamedFile{"--marks", a.marks}};
  const std::array outputs{NamedFile{"OUTPUT", a.output}};
  if (auto distinct = check_distinct(inputs, outputs); !distinct) return fail(distinct.error());
  return **format;
}

Result<Outcome> track(const TrackArguments& a, const StopSignal& stop) {
  const auto format = check(a);
  if (!format) return fail(format.error());
  auto opened = open_source_part(a.input, {a.frames, a.duration}, a.sequence_rate, a.rotate, stop);
  if (!opened) return fail(opened.error());
  SourcePart& source = *opened;
  const auto settings = settings_of(a);
  if (!settings) return fail(settings.error());
  auto encoder = Encoder::create(source.format(), *settings);
  if (!encoder) return fail(about_input(encoder.error(), a.input));
  auto out = TableOutput::create(a.output, *format);
  if (!out) return fail(out.error());
  if (auto begun = out->begin(source.format()); !begun) return fail(begun.error());
  Tracker tracker(std::move(*encoder), *out);
  if (auto done = track_all(source, tracker, a.quiet); !done) return fail(about_input(done.error(), a.input));
  if (auto finished = out->finish(); !finished) return fail(finished.error());
  print_source_warning(a.input, source, tracker.pictures(), "tracked", a.quiet);
  return source.is_whole() ? Outcome::kComplete : Outcome::kPartial;
}

}  // namespace
}  // namespace fbs::cli

FBS_MODULE_EXPORT void fbs_run_track(const fbs::cli::TrackArguments& arguments,
                                     fbs::Result<fbs::cli::Outcome>& result) {
  result =
      fbs::cli::until_stopped(arguments.quiet, fbs::cli::kFinishingTable, "no table written",
                              [&](const fbs::StopSignal& stop) { return fbs::cli::track(arguments, stop); });
}
