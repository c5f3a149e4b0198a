#include "cli/evaluate/argument_check.h"

#include <algorithm>
#include <filesystem>

#include "cli/files/output_check.h"

namespace fbs::cli {
namespace {

namespace fs = std::filesystem;

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
  const char* option = !a.qualities.empty() ? "--quality"
                       : a.live             ? "--live"
                       : a.allow_no_face    ? "--allow-no-face"
                                            : nullptr;
  if (option == nullptr) return {};
  return refuse(std::string(option) + " is for encoding: it does nothing for " + a.streams.front() +
                ", which is a stream already");
}

Result<void> check_outputs(const EvaluateArguments& a, const std::vector<std::string>& clips) {
  for (const auto& [option, name] : {std::pair{"--csv", a.csv}, std::pair{"--html", a.html}})
    if (name == "-") return refuse(std::string(option) + " - : needs the name of a file");
  std::vector<NamedFile> inputs{{"SOURCE", a.source}, {"--region", a.region}};
  for (const std::string& stream : a.streams) inputs.push_back({"STREAM", stream});
  for (const std::string& clip : clips) inputs.push_back({"the video", clip});
  const std::vector<NamedFile> outputs{{"--csv", a.csv}, {"--html", a.html}};
  if (auto distinct = check_distinct(inputs, outputs); !distinct) return distinct;
  for (const std::string& name : {a.csv, a.html}) {
    const fs::path folder = fs::path(name).parent_path();
    if (!folder.empty() && !fs::is_directory(folder))
      return refuse("cannot write " + name + ": there is no folder " + folder.string());
  }
  return {};
}

}  // namespace

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

}  // namespace fbs::cli
