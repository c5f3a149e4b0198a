#include "cli/evaluate/quality/vmaf.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

namespace fbs::cli {
namespace {

int even(int n) {
  return (n + 1) / 2 * 2;
}

/// Only luma counts; chroma is passed as grey. Odd sides get a row or column that is cut off again.
void append_luma(const Plane& plane, std::vector<std::uint8_t>& out) {
  const auto width = static_cast<std::size_t>(even(plane.width));
  for (int y = 0; y < even(plane.height); ++y) {
    const std::uint8_t* row = plane.row(std::min(y, plane.height - 1));
    out.insert(out.end(), row, row + plane.width);
    out.resize(out.size() + width - static_cast<std::size_t>(plane.width));
  }
}

}  // namespace

bool has_vmaf() {
  return output_of({"ffmpeg", "-v", "quiet", "-filters"}).find(" libvmaf ") != std::string::npos;
}

Result<VmafMeter> VmafMeter::start(int width, int height, const std::string& log) {
  const auto text = [](int n) { return std::to_string(n); };
  const std::string crop = "crop=" + text(width) + ":" + text(height) + ":0:";
  // A colon in the log's name would end the option.
  std::string log_name;
  for (const char c : log + ".json") {
    if (std::string("\\:',;[]").find(c) != std::string::npos) log_name += "\\\\\\";
    log_name += c;
  }
  auto ffmpeg =
      ChildProcess::start({"ffmpeg", "-v", "error", "-f", "rawvideo", "-pix_fmt", "yuv420p", "-s",
                           text(even(width)) + "x" + text(2 * even(height)), "-i", "-", "-lavfi",
                           "split[a][b];[a]" + crop + "0:exact=1[r];[b]" + crop + text(even(height)) +
                               ":exact=1[d];[d][r]libvmaf=log_fmt=json:log_path=" + log_name,
                           "-f", "null", "-"},
                          ChildProcess::Pipe::kToStandardInput, log);
  if (!ffmpeg) return fail(ffmpeg.error());
  return VmafMeter(std::move(*ffmpeg), log);
}

Result<void> VmafMeter::add(const Picture& source, const Picture& shown) {
  std::vector<std::uint8_t> both;
  append_luma(source.y, both);
  append_luma(shown.y, both);
  both.resize(both.size() * 3 / 2, 128);
  if (ffmpeg_.write(both)) return {};
  auto finished = ffmpeg_.finish();
  return fail(finished ? Error{ErrorCode::kIo, "ffmpeg: ended before all pictures were compared"}
                       : finished.error());
}

Result<double> VmafMeter::finish() {
  if (auto finished = ffmpeg_.finish(); !finished) return fail(finished.error());
  std::ifstream file(log_ + ".json");
  const auto read = nlohmann::json::parse(file, nullptr, false);
  const nlohmann::json::json_pointer mean("/pooled_metrics/vmaf/mean");
  if (!read.is_object() || !read.contains(mean))
    return fail(ErrorCode::kIo, "ffmpeg: its libvmaf wrote no result");
  return read.at(mean).get<double>();
}

}  // namespace fbs::cli
