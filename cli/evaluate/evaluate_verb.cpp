// fbs evaluate: rate and distortion of streams against their source.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "cli/evaluate/folder_evaluation.h"
#include "cli/evaluate/rate_distortion/clip_means.h"
#include "cli/evaluate/report/data_report.h"
#include "cli/evaluate/report/html_report.h"
#include "cli/evaluate/report/stills.h"
#include "cli/evaluate/report/text_report.h"
#include "cli/files/output_check.h"
#include "cli/program/module.h"
#include "cli/program/outcome.h"
#include "cli/source/encoder_module.h"

namespace fbs::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStoppingEvaluation = "fbs: stopping; a second signal ends at once";

Result<void> refuse(const std::string& text) {
  return fail(ErrorCode::kInvalidArgument, text);
}

Result<void> check_folder(const EvaluateArguments& a) {
  if (!a.streams.empty()) return refuse(a.source + ": is a folder of videos: STREAM goes with one video");
  if (!a.region.empty()) return refuse(a.source + ": is a folder of videos: --region goes with one video");
  if (!a.stills.empty()) return refuse(a.source + ": is a folder of videos: --stills goes with one video");
  return {};
}

Result<void> check_streams(const EvaluateArguments& a) {
  if (std::count(a.streams.begin(), a.streams.end(), "-") + (a.source == "-" ? 1 : 0) > 1)
    return refuse("- : standard input can be read once only");
  const char* option = !a.qualities.empty()  ? "--quality"
                       : !a.bitrates.empty() ? "--bitrate"
                       : a.live              ? "--live"
                       : a.allow_no_face     ? "--allow-no-face"
                                             : nullptr;
  if (option == nullptr) return {};
  return refuse(std::string(option) + " is for encoding: it does nothing for " + a.streams.front() +
                ", which is a stream already");
}

Result<void> check_outputs(const EvaluateArguments& a, const std::vector<std::string>& clips) {
  // A video behind --json would be its FILE.
  if (!a.json.empty() && a.json != "-" && extension_of(a.json) != ".json" && !is_device(a.json))
    return refuse("--json " + a.json +
                  ": the name of the file ends in .json; for standard output use --json -");
  std::vector<NamedFile> inputs{{"SOURCE", a.source}, {"--region", a.region}};
  for (const std::string& stream : a.streams) inputs.push_back({"STREAM", stream});
  for (const std::string& clip : clips) inputs.push_back({"the video", clip});
  const std::vector<NamedFile> outputs{{"--csv", a.csv}, {"--html", a.html}, {"--json", a.json}};
  if (auto distinct = check_distinct(inputs, outputs); !distinct) return distinct;
  for (const std::string& name : {a.csv, a.html, a.json}) {
    const fs::path folder = fs::path(name).parent_path();
    if (!folder.empty() && !fs::is_directory(folder))
      return refuse("cannot write " + name + ": there is no folder " + folder.string());
  }
  return {};
}

/// @param clips  videos in the folder; empty where the source is a video itself
/// @return kInvalidArgument for an option without effect, and for an output that is an input
Result<void> check_arguments(const EvaluateArguments& a, const std::vector<std::string>& clips) {
  if (a.source.starts_with("camera:"))
    return refuse(a.source + ": a camera does not show the same twice; record it first");
  if (!clips.empty())
    if (auto checked = check_folder(a); !checked) return checked;
  if (clips.empty() && a.jobs && fs::exists(a.source))
    return refuse("--jobs is for a folder of videos, which " + a.source + " is not");
  if (!a.streams.empty())
    if (auto checked = check_streams(a); !checked) return checked;
  return check_outputs(a, clips);
}

/// Folder for finished results; empty: none.
std::string kept_folder(const EvaluateArguments& arguments) {
  if (!arguments.keep.empty() || arguments.html.empty() || arguments.html == "-") return arguments.keep;
  return fs::path(arguments.html).replace_extension(".fbs-run").string();
}

nlohmann::json folder_json(const EvaluateArguments& arguments, const FolderReport& report) {
  nlohmann::json clips = nlohmann::json::array();
  for (const ClipReport& clip : report.clips) clips.push_back(clip_json(clip));
  nlohmann::json out = {{"source", arguments.source}, {"clips", clips}, {"failed", report.failed}};
  if (!arguments.peers) return out;
  const auto value = [&](Area area) {
    const auto mean = mean_bd_rate(report.clips, area);
    return mean ? nlohmann::json(*mean) : nlohmann::json();
  };
  out["mean_bd_rate"] = {{"face", value(Area::kFace)}, {"frame", value(Area::kFrame)}};
  return out;
}

Result<void> write_files(const EvaluateArguments& arguments, const std::vector<ClipReport>& clips,
                         const nlohmann::json& results) {
  if (!arguments.csv.empty())
    if (auto written = write_csv(arguments.csv, clips); !written) return written;
  if (!arguments.json.empty())
    if (auto written = write_json(arguments.json, results); !written) return written;
  if (arguments.html.empty()) return {};
  return write_html(arguments.html, arguments.source, clips);
}

/// Whether nothing else goes there.
bool has_standard_output(const EvaluateArguments& a) {
  return a.csv != "-" && a.html != "-" && a.json != "-";
}

Result<Outcome> evaluate_single(const EvaluateArguments& arguments, const Tools& tools, const RunFolder& run,
                                const StopSignal& stop) {
  auto clip = evaluate_clip(arguments, arguments.source, tools, run, stop);
  if (!clip) return fail(clip.error());
  const bool whole = clip->whole;
  std::vector<ClipReport> clips{std::move(*clip)};
  if (auto written = write_files(arguments, clips, clip_json(clips.front())); !written)
    return fail(written.error());
  if (!arguments.stills.empty()) {
    const auto stills = make_stills(clips.front());
    if (!stills) return fail(stills.error());
    if (auto written = write_stills(arguments.stills, *stills); !written) return fail(written.error());
  }
  if (has_standard_output(arguments)) print_clip(clips.front());
  return whole ? Outcome::kComplete : Outcome::kPartial;
}

Result<Outcome> evaluate_clips(const EvaluateArguments& arguments, const std::vector<std::string>& names,
                               const Tools& tools, const RunFolder& run, const StopSignal& stop) {
  const auto report = evaluate_folder(arguments, names, tools, run, stop);
  if (!report) return fail(report.error());
  if (report->clips.empty()) return fail(ErrorCode::kInvalidArgument, report->failed.front());
  if (auto written = write_files(arguments, report->clips, folder_json(arguments, *report)); !written)
    return fail(written.error());
  if (has_standard_output(arguments)) print_clips(report->clips);
  for (const std::string& line : report->failed) std::fprintf(stderr, "fbs: left out: %s\n", line.c_str());
  const bool whole =
      std::all_of(report->clips.begin(), report->clips.end(), [](const ClipReport& c) { return c.whole; });
  return whole && report->failed.empty() ? Outcome::kComplete : Outcome::kPartial;
}

Result<Outcome> evaluate(const EvaluateArguments& arguments, const StopSignal& stop) {
  const std::vector<std::string> clips = clips_in(arguments.source);
  if (auto checked = check_arguments(arguments, clips); !checked) return fail(checked.error());
  const auto tools = find_tools(arguments);
  if (!tools) return fail(tools.error());
  const std::string kept = kept_folder(arguments);
  const auto run = kept.empty() ? RunFolder::temporary() : RunFolder::open(kept);
  if (!run) return fail(run.error());
  return clips.empty() ? evaluate_single(arguments, *tools, *run, stop)
                       : evaluate_clips(arguments, clips, *tools, *run, stop);
}

/// Evaluates until the end or a signal.
Result<Outcome> evaluate_until_stopped(const EvaluateArguments& arguments) {
  const StopSignal stop(arguments.quiet ? nullptr : kStoppingEvaluation);
  auto outcome = evaluate(arguments, stop);
  if (!stop.raised() || outcome) return outcome;
  const std::string kept = kept_folder(arguments);
  if (kept.empty())
    std::fprintf(stderr, "fbs: stopped by %s\n", stop.name());
  else
    std::fprintf(
        stderr,
        "fbs: stopped by %s; what is finished is kept in %s, and the same command goes on from there\n",
        stop.name(), kept.c_str());
  return outcome_of_stop(stop.number());
}

}  // namespace
}  // namespace fbs::cli

FBS_MODULE_EXPORT void fbs_run_evaluate(const fbs::cli::EvaluateArguments& arguments,
                                        fbs::Result<fbs::cli::Outcome>& result) {
  result = fbs::cli::evaluate_until_stopped(arguments);
}
