// fbs evaluate: rate and distortion of a stream against its source.
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "cli/encode/encode_session.h"
#include "cli/encode/source_part.h"
#include "cli/evaluate/evaluate_arguments.h"
#include "cli/module.h"
#include "cli/outcome.h"
#include "cli/progress.h"
#include "cli/stream/byte_count_json.h"
#include "cli/stream/stream_file.h"

namespace fbs::cli {
namespace {

struct Point {
  std::string label;
  Measure measure;
  std::optional<EncodingReport> report{};  ///< nothing of a stream that was given: it does not say
};

Result<SourcePart> open_source(const std::string& name) {
  auto source = open_video_source(name);
  if (!source) return fail(source.error());
  return SourcePart(std::move(*source), {}, nullptr);
}

Result<Measure> measure_stream(const EvaluateArguments& arguments, SourcePart& source) {
  auto file = StreamFile::open(arguments.stream);
  if (!file) return fail(file.error());
  StreamMeter meter(file->decoder(), Measured::kSsim);
  Progress progress("evaluating", source.frame_count_estimate(), arguments.quiet);
  for (std::int64_t n = 1;; ++n) {
    auto status = file->next();
    if (!status) return fail(status.error());
    auto picture = source.next();
    if (!picture) return fail(picture.error());
    const bool ended = *status == DecodeStatus::kEnd;
    if (ended && !*picture) return meter.result();
    if (ended || !*picture)
      return fail(ErrorCode::kInvalidArgument, arguments.stream + ": has " + (ended ? "fewer" : "more") +
                                                   " pictures than " + arguments.source);
    const VideoFormat &a = file->decoder().format(), &b = source.format();
    if (a.width != b.width || a.height != b.height)
      return fail(ErrorCode::kInvalidArgument,
                  arguments.stream + ": picture size differs from " + arguments.source);
    if (auto compared = meter.compare((*picture)->picture); !compared) return fail(compared.error());
    progress.update(n);
  }
}

Result<Encoded> measure_encoding(const EvaluateArguments& arguments, int quality, SourcePart& source) {
  EncoderSettings settings;
  settings.quality = quality;
  settings.allow_no_face = arguments.allow_no_face;
  if (arguments.live) settings.live.emplace();
  auto encoded = encode_source(
      source, settings, [](std::span<const std::uint8_t>) { return Result<void>{}; }, {}, Measured::kSsim,
      arguments.quiet);
  if (!encoded) {
    Error error = encoded.error();
    error.text = arguments.source + ": " + error.text;
    return fail(std::move(error));
  }
  return encoded;
}

nlohmann::json to_json(const Point& p) {
  const Measure& m = p.measure;
  nlohmann::json j = {{"point", p.label},
                      {"frames", m.pictures},
                      {"seconds", m.seconds},
                      {"kbps", m.kbps()},
                      {"bytes", byte_count_json(m.bytes)},
                      {"psnr_frame", m.frame.psnr()},
                      {"ssim_frame", m.ssim_frame}};
  if (m.face.count > 0) {
    j["psnr_face"] = m.face.psnr();
    j["ssim_face"] = m.ssim_face;
  }
  if (p.report) {
    j["cuts"] = p.report->cuts;
    j["frames_without_face"] = p.report->without_face;
  }
  return j;
}

void print(const std::vector<Point>& points) {
  std::printf("%-20s %9s %9s %9s %9s %9s %9s %8s %9s %8s %10s\n", "", "kbit/s", "motion", "startup B",
              "geometry", "patterns", "total B", "face dB", "face SSIM", "frame dB", "frame SSIM");
  for (const Point& p : points) {
    const Measure& m = p.measure;
    const auto b = [](std::uint64_t v) { return static_cast<unsigned long long>(v); };
    std::printf("%-20s %9.3f %9.3f %9llu %9llu %9llu %9llu %8.2f %9.4f %8.2f %10.4f\n", p.label.c_str(),
                m.kbps(), m.rate(m.bytes.motion), b(m.bytes.startup), b(m.bytes.geometry),
                b(m.bytes.patterns), b(m.bytes.total), m.face.psnr(), m.ssim_face, m.frame.psnr(),
                m.ssim_frame);
    if (const std::string notes = p.report ? notes_of(*p.report) : ""; !notes.empty())
      std::printf("  %s\n", notes.c_str());
  }
}

Result<Outcome> evaluate(const EvaluateArguments& arguments) {
  std::vector<Point> points;
  std::optional<SourcePart> source;
  const auto reopen = [&]() -> Result<void> {
    auto opened = open_source(arguments.source);
    if (!opened) return fail(opened.error());
    source.emplace(std::move(*opened));
    return {};
  };
  if (!arguments.stream.empty()) {
    if (auto opened = reopen(); !opened) return fail(opened.error());
    auto m = measure_stream(arguments, *source);
    if (!m) return fail(m.error());
    points.push_back({arguments.stream, *m, std::nullopt});
  } else {
    for (const int quality : arguments.qualities) {
      if (auto opened = reopen(); !opened) return fail(opened.error());
      auto m = measure_encoding(arguments, quality, *source);
      if (!m) return fail(m.error());
      points.push_back({"quality " + std::to_string(quality), m->measure, m->report});
    }
  }
  print_source_warning(arguments.source, *source, points.front().measure.pictures, "measured");
  if (arguments.json) {
    nlohmann::json list = nlohmann::json::array();
    for (const Point& p : points) list.push_back(to_json(p));
    std::printf("%s\n", nlohmann::json{{"source", arguments.source}, {"points", list}}.dump(1).c_str());
  } else {
    print(points);
  }
  return source->is_whole() ? Outcome::kComplete : Outcome::kPartial;
}

}  // namespace
}  // namespace fbs::cli

FBS_MODULE_EXPORT void fbs_run_evaluate(const fbs::cli::EvaluateArguments& arguments,
                                        fbs::Result<fbs::cli::Outcome>& result) {
  result = fbs::cli::evaluate(arguments);
}
