#include "cli/evaluate/folder_evaluation.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <thread>

#include "cli/program/progress.h"

namespace fbs::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 14> kVideoSuffixes{".mkv", ".mp4", ".webm", ".y4m",  ".mov",
                                                          ".avi", ".m4v", ".mpg",  ".mpeg", ".ts",
                                                          ".ogv", ".flv", ".wmv",  ".3gp"};

bool is_video(const fs::path& path) {
  std::string suffix = path.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(kVideoSuffixes.begin(), kVideoSuffixes.end(), suffix) != kVideoSuffixes.end();
}

Result<ClipReport> evaluate_one(const EvaluateArguments& arguments, const std::string& clip,
                                const Tools& tools, const RunFolder& run, const StopSignal& stop) {
  try {
    auto folder = RunFolder::open(run.path(fs::path(clip).filename().string()));
    if (!folder) return fail(folder.error());
    return evaluate_clip(arguments, clip, tools, *folder, stop);
  } catch (const std::exception& problem) {  // such as out of memory: in a thread it would end the program
    return fail(ErrorCode::kInternal, clip + ": " + problem.what());
  }
}

}  // namespace

std::vector<std::string> clips_in(const std::string& path) {
  std::vector<std::string> out;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(path, error))
    if (entry.is_regular_file(error) && is_video(entry.path())) out.push_back(entry.path().string());
  std::sort(out.begin(), out.end());
  return out;
}

Result<FolderReport> evaluate_folder(const EvaluateArguments& arguments,
                                     const std::vector<std::string>& clips, const Tools& tools,
                                     const RunFolder& run, const StopSignal& stop) {
  EvaluateArguments each = arguments;
  each.quiet = true;  // several bars at the same time would be unreadable
  std::vector<std::optional<Result<ClipReport>>> results(clips.size());
  std::atomic<std::size_t> next = 0, finished = 0;
  const auto begun = std::chrono::steady_clock::now();
  const auto time_left = [&](std::size_t done) -> std::string {
    if (isatty(STDERR_FILENO) != 1) return "";
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begun;
    const double left = taken.count() / static_cast<double>(done) * static_cast<double>(clips.size() - done);
    return ", " + std::to_string(done) + " of " + std::to_string(clips.size()) +
           (done < clips.size() ? ", " + duration_text(left) + " left" : "");
  };
  const auto work = [&] {
    for (std::size_t i = next++; i < clips.size() && !stop.raised(); i = next++) {
      results[i] = evaluate_one(each, clips[i], tools, run, stop);
      if (!arguments.quiet && !stop.raised())
        std::fprintf(stderr, "fbs: %s: %s%s\n", clips[i].c_str(), *results[i] ? "evaluated" : "failed",
                     time_left(++finished).c_str());
    }
  };
  std::vector<std::thread> threads;
  const auto count = std::min(static_cast<std::size_t>(arguments.jobs.value_or(1)), clips.size());
  for (std::size_t i = 1; i < count; ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  if (stop.raised()) return fail(ErrorCode::kIo, arguments.source + ": stopped");
  FolderReport report;
  for (auto& result : results) {
    if (*result)
      report.clips.push_back(std::move(**result));
    else
      report.failed.push_back(result->error().text);
  }
  return report;
}

}  // namespace fbs::cli
