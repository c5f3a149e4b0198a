#include "cli/evaluate/clip_evaluation.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <utility>

#include "cli/evaluate/measurement.h"
#include "cli/evaluate/peers/peer_encoding.h"
#include "cli/evaluate/quality/face_regions.h"
#include "cli/evaluate/quality/vmaf.h"
#include "cli/evaluate/report/chart_ticks.h"
#include "cli/evaluate/run/file_stamp.h"
#include "cli/files/atomic_file.h"
#include "cli/source/encode_session.h"
#include "cli/stream/stream_file.h"
#include "cli/video/open/open_video.h"
#include "cli/video/y4m/y4m.h"

namespace fbs::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Peers are coded at increasing rates until they exceed fbs's best stream by this factor.
constexpr double kRateToCover = 1.25;

/// The evaluation of one source.
class ClipEvaluation {
 public:
  ClipEvaluation(const EvaluateArguments& arguments, const Tools& tools, const RunFolder& run,
                 const StopSignal& stop)
      : arguments_(arguments), tools_(tools), run_(run), stop_(stop) {}

  Result<ClipReport> of(const std::string& source) {
    clip_.source = source;
    clip_.vmaf_available = tools_.vmaf;
    return open(source)
        .and_then([&] { return make_streams(); })
        .and_then([&] { return read_tracks(); })
        .and_then([&] { return measure_streams(); })
        .and_then([&] { return measure_peers(); })
        .map([&] { return std::move(clip_); });
  }

 private:
  Result<void> open(const std::string& source);
  Result<void> copy_source(const std::string& name);
  Result<void> copy_stream(RdPoint& point);
  Result<void> make_streams();
  /// @param name  of the file, without its suffix
  Result<void> encode(const std::string& name, const std::string& label, EncoderSettings settings);
  Result<void> read_tracks();
  Result<void> take_regions(std::vector<StreamTrack>& tracks);
  Result<void> measure_streams();
  Result<void> measure_peers();
  /// From the lowest rate up, until fbs's rates are covered.
  /// Sizes and rates that were asked for.
  [[nodiscard]] std::vector<PeerVariant> wanted_variants() const;
  Result<void> climb(const PeerCodec& codec, const PeerVariant& variant, double enough_kbps);
  Result<RdPoint> peer_point(const PeerCodec& codec, const PeerVariant& variant, int crf);
  /// Measures a point, unless that has been done.
  template <class Open>
  Result<void> measure(const std::string& name, const Open& open, RdPoint& point);

  const EvaluateArguments& arguments_;
  const Tools& tools_;
  const RunFolder& run_;
  const StopSignal& stop_;
  const PartLimits limits_{arguments_.frames, {}};
  ClipReport clip_;
  json key_;  ///< of everything made from the source
  FaceRegions regions_;
  bool warned_ = false;
};

/// Whether a source can be read only once.
bool is_pipe(const std::string& name) {
  std::error_code error;
  return name == "-" || fs::is_fifo(name, error);
}

Result<void> ClipEvaluation::copy_source(const std::string& name) {
  clip_.read_from = run_.path("source.y4m");
  SourceOptions options;
  options.rotate = arguments_.rotate;
  options.stop = &stop_;
  auto source = open_video_source(name, options);
  if (!source) return fail(source.error());
  auto sink = open_y4m_sink(clip_.read_from, (*source)->format());
  if (!sink) return fail(sink.error());
  for (;;) {
    auto picture = (*source)->next();
    if (!picture) return fail(picture.error());
    if (!*picture) {
      if (!arguments_.quiet) print_notes(name, **source);  // the copy has none
      return (*sink)->finish();
    }
    if (auto written = (*sink)->write((*picture)->picture, (*picture)->pts); !written) return written;
  }
}

Result<void> ClipEvaluation::copy_stream(RdPoint& point) {
  auto stream = StreamFile::open(point.label, &stop_);
  if (!stream) return fail(stream.error());
  const auto bytes = stream->read_all();
  if (!bytes) return fail(bytes.error());
  point.file = run_.path("stream.fbs");
  auto file = AtomicFile::create(point.file);
  if (!file) return fail(file.error());
  return file->write(*bytes).and_then([&] { return file->commit(); });
}

Result<void> ClipEvaluation::open(const std::string& source) {
  clip_.read_from = source;
  if (is_pipe(source) || arguments_.rotate != 0)
    if (auto copied = copy_source(source); !copied) return copied;
  auto opened = open_video_source(clip_.read_from);
  if (!opened) return fail(opened.error());
  clip_.format = (*opened)->format();
  key_ = {{"source", file_stamp(is_pipe(source) ? clip_.read_from : source)},
          {"rotate", arguments_.rotate},
          {"frames", arguments_.frames.value_or(0)},
          {"program", program_stamp()}};
  return {};
}

Result<void> ClipEvaluation::make_streams() {
  for (const std::string& stream : arguments_.streams) {
    RdPoint& point = clip_.points.emplace_back();
    point.label = point.file = stream;
    point.codec = "fbs";
    if (is_pipe(stream))
      if (auto copied = copy_stream(point); !copied) return copied;
  }
  if (!arguments_.streams.empty()) return {};
  EncoderSettings settings;
  for (const double kbps : arguments_.bitrates) {
    settings.bitrate = kbps;
    const std::string number = tick_text(kbps);
    const std::string name = (arguments_.live ? "live-bitrate-" : "bitrate-") + number;
    if (auto encoded = encode(name, number + " kbit/s", settings); !encoded) return encoded;
  }
  if (!arguments_.bitrates.empty()) return {};
  std::vector<int> qualities = arguments_.qualities;
  if (qualities.empty()) qualities.assign(std::begin(kDefaultQualities), std::end(kDefaultQualities));
  for (const int quality : qualities) {
    settings.quality = quality;
    const std::string number = std::to_string(quality);
    const std::string name = (arguments_.live ? "live-" : "quality-") + number;
    if (auto encoded = encode(name, "quality " + number, settings); !encoded) return encoded;
  }
  return {};
}

json report_json(const EncodingReport& r) {
  return {{"pictures", r.pictures}, {"without_face", r.without_face}, {"cuts", r.cuts}, {"scenes", r.scenes}};
}

EncodingReport read_report(const json& j) {
  const auto number = [&](const char* name) { return j.value(name, std::uint64_t{0}); };
  return {number("pictures"), number("without_face"), number("cuts"), number("scenes")};
}

Result<void> ClipEvaluation::encode(const std::string& name, const std::string& label,
                                    EncoderSettings settings) {
  RdPoint& point = clip_.points.emplace_back();
  point.label = label;
  point.codec = "fbs";
  point.file = run_.path(name + ".fbs");
  json key = key_;
  key["allow_no_face"] = arguments_.allow_no_face;
  if (const auto made = run_.find(name, key);
      made && made->value("stream", json()) == file_stamp(point.file)) {
    point.report = read_report((*made)["report"]);
    return {};
  }
  settings.allow_no_face = arguments_.allow_no_face;
  if (arguments_.jobs.value_or(1) > 1) settings.threads = 1;  // the clips share the cores
  if (arguments_.live) settings.live.emplace();
  SourceOptions options;
  options.stop = &stop_;
  auto opened = open_video_source(clip_.read_from, options);
  if (!opened) return fail(opened.error());
  SourcePart source(std::move(*opened), limits_, &stop_);
  auto file = AtomicFile::create(point.file);
  if (!file) return fail(file.error());
  const auto encoded = encode_source(
      source, settings, [&](std::span<const std::uint8_t> bytes) { return file->write(bytes); }, {},
      Measured::kRate, arguments_.quiet);
  if (stop_.raised()) return fail(ErrorCode::kIo, clip_.source + ": stopped");
  if (!encoded) {
    Error error = encoded.error();
    error.text = clip_.source + ": " + error.text;
    return fail(std::move(error));
  }
  if (auto committed = file->commit(); !committed) return committed;
  point.report = encoded->report;
  if (!source.is_whole()) return {};
  return run_.keep(name, key, {{"stream", file_stamp(point.file)}, {"report", report_json(*point.report)}});
}

Result<void> ClipEvaluation::read_tracks() {
  std::vector<StreamTrack> tracks;
  for (RdPoint& point : clip_.points) {
    auto track = read_track(point.file, &stop_);
    if (!track) return fail(track.error());
    point.bytes = track->bytes;
    point.seconds = track->seconds;
    tracks.push_back(std::move(*track));
  }
  clip_.times = tracks.front().times;
  clip_.seconds = tracks.front().seconds;
  return take_regions(tracks);
}

Result<void> ClipEvaluation::take_regions(std::vector<StreamTrack>& tracks) {
  if (!arguments_.region.empty()) {
    auto read = read_region(arguments_.region, &stop_);
    if (!read) return fail(read.error());
    regions_ = std::move(*read);
    if (regions_.outlines.size() > tracks.front().times.size())
      return fail(ErrorCode::kInvalidArgument, arguments_.region + ": has " +
                                                   std::to_string(regions_.outlines.size()) +
                                                   " pictures, more than " + clip_.source);
  } else {
    // The first of given streams; else the one of the highest quality.
    std::size_t best = 0;
    if (arguments_.streams.empty())
      for (std::size_t i = 1; i < tracks.size(); ++i)
        if (tracks[i].bytes.total > tracks[best].bytes.total) best = i;
    regions_ = {"the mesh of " + clip_.points[best].label, std::move(tracks[best].outlines)};
  }
  clip_.region_origin = regions_.origin;
  clip_.believed = regions_.believed();
  return {};
}

template <class Open>
Result<void> ClipEvaluation::measure(const std::string& name, const Open& open, RdPoint& point) {
  json key = key_;
  key["stream"] = file_stamp(point.file);
  key["regions"] = regions_.hash();
  key["vmaf"] = tools_.vmaf;
  if (const auto found = run_.find(name, key); found && read_quality(*found, point)) return {};
  auto shown = open();
  if (!shown) return fail(shown.error());
  MeasurementSetting setting{clip_.read_from, limits_, &regions_, tools_.vmaf, arguments_.quiet, &stop_};
  const auto source = measure_pictures(setting, **shown, run_.path(name + ".log"), point);
  if (!source) return fail(source.error());
  if (!std::exchange(warned_, true))
    print_source_warning(clip_.source, *source, point.pictures.size(), "measured", arguments_.quiet);
  clip_.whole = clip_.whole && source->is_whole();
  return source->is_whole() ? run_.keep(name, key, quality_json(point)) : Result<void>{};
}

Result<void> ClipEvaluation::measure_streams() {
  for (std::size_t i = 0; i < clip_.points.size(); ++i) {
    RdPoint& point = clip_.points[i];
    const std::string name = arguments_.streams.empty() ? fs::path(point.file).stem().string() + ".measured"
                                                        : "stream-" + std::to_string(i) + ".measured";
    const auto open = [&] { return open_fbs_pictures(point.file, &stop_); };
    if (auto measured = measure(name, open, point); !measured) return measured;
  }
  return {};
}

Result<RdPoint> ClipEvaluation::peer_point(const PeerCodec& codec, const PeerVariant& variant, int crf) {
  RdPoint point;
  point.label = peer_label(codec, variant, crf);
  point.codec = codec.name;
  point.seconds = clip_.seconds;
  point.step = variant.step;
  const std::string name = codec.encoder + "-" + std::to_string(variant.divisor) + "x" +
                           std::to_string(variant.step) + "-crf" + std::to_string(crf);
  point.file = run_.path(name + "." + codec.suffix);
  json key = {{"source", key_["source"]},
              {"rotate", key_["rotate"]},
              {"frames", key_["frames"]},
              {"options", codec.options}};
  const auto made = run_.find(name, key);
  if (!made || *made != file_stamp(point.file)) {
    if (auto coded = encode_peer(clip_.read_from, limits_,
                                 {codec, variant, crf, point.file, arguments_.quiet}, &stop_);
        !coded)
      return fail(coded.error());
    if (clip_.whole)
      if (auto kept = run_.keep(name, key, file_stamp(point.file)); !kept) return fail(kept.error());
  }
  const auto bytes = packet_bytes(point.file);
  if (!bytes) return fail(bytes.error());
  point.bytes.total = *bytes;
  const auto open = [&] {
    return open_peer_pictures(
        {point.file, clip_.format.width, clip_.format.height, variant.step, clip_.times.size()});
  };
  if (auto measured = measure(name + ".measured", open, point); !measured) return fail(measured.error());
  return point;
}

Result<void> ClipEvaluation::climb(const PeerCodec& codec, const PeerVariant& variant, double enough_kbps) {
  for (const int crf : codec.crfs) {
    auto point = peer_point(codec, variant, crf);
    if (!point) return fail(point.error());
    const bool covered = point->kbps() >= enough_kbps;
    clip_.peers.push_back(std::move(*point));
    if (covered) break;
  }
  return {};
}

std::vector<PeerVariant> ClipEvaluation::wanted_variants() const {
  const auto wanted = [](const std::vector<int>& list, int value) {
    return list.empty() || std::ranges::find(list, value) != list.end();
  };
  std::vector<PeerVariant> out;
  for (const PeerVariant& variant : peer_variants(clip_.format.width, clip_.format.height))
    if (wanted(arguments_.peer_sizes, variant.divisor) && wanted(arguments_.peer_rates, variant.step))
      out.push_back(variant);
  return out;
}

Result<void> ClipEvaluation::measure_peers() {
  clip_.compared = !tools_.peers.empty();
  double enough_kbps = 0;
  for (const RdPoint& p : clip_.points) enough_kbps = std::max(enough_kbps, kRateToCover * p.kbps());
  for (const PeerCodec& codec : tools_.peers)
    for (const PeerVariant& variant : wanted_variants())
      if (auto climbed = climb(codec, variant, enough_kbps); !climbed) return climbed;
  return {};
}

}  // namespace

Result<Tools> find_tools(const EvaluateArguments& arguments) {
  Tools tools;
  tools.vmaf = has_vmaf();
  if (!arguments.peers) return tools;
  tools.peers = installed_peers(arguments.live);
  if (tools.peers.empty())
    return fail(ErrorCode::kUnsupported,
                arguments.live
                    ? "--live --peers needs ffmpeg with libaom-av1, and finds none"
                    : "--peers needs ffmpeg with libx264, libx265, libsvtav1 or libaom-av1, and finds none");
  if (arguments.peer_codecs.empty()) return tools;
  std::vector<PeerCodec> wanted;
  for (const std::string& name : arguments.peer_codecs) {
    const auto found = std::ranges::find(tools.peers, name, &PeerCodec::option);
    if (found == tools.peers.end())
      return fail(ErrorCode::kUnsupported, "--peer-codec " + name +
                                               (arguments.live ? ": --live is compared with av1 alone"
                                                               : ": ffmpeg has no encoder of it"));
    wanted.push_back(*found);
  }
  tools.peers = std::move(wanted);
  return tools;
}

Result<ClipReport> evaluate_clip(const EvaluateArguments& arguments, const std::string& source,
                                 const Tools& tools, const RunFolder& run, const StopSignal& stop) {
  return ClipEvaluation(arguments, tools, run, stop).of(source);
}

}  // namespace fbs::cli
