#include "cli/evaluate/peers/peer_encoding.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

#include "cli/evaluate/peers/child_process.h"
#include "cli/program/progress.h"
#include "cli/video/open/open_video.h"

namespace fbs::cli {
namespace {

namespace fs = std::filesystem;

std::string rate_text(const Rational& rate, int step) {
  return std::to_string(rate.num) + "/" + std::to_string(static_cast<std::int64_t>(rate.den) * step);
}

/// A side divided and made even, as 4:2:0 encoders need it.
std::string side_text(int side, int divisor) {
  return std::to_string((side / divisor + 1) / 2 * 2);
}

std::vector<std::string> command_of(const VideoFormat& format, const PeerJob& job, const std::string& file) {
  const auto side = [&](int n) { return side_text(n, job.variant.divisor); };
  std::vector<std::string> out{
      "ffmpeg",   "-v",
      "error",    "-y",
      "-f",       "rawvideo",
      "-pix_fmt", "yuv420p",
      "-s",       std::to_string(format.width) + "x" + std::to_string(format.height),
      "-r",       rate_text(format.frame_rate, job.variant.step),
      "-i",       "-",
      "-vf",      "scale=" + side(format.width) + ":" + side(format.height) + ":flags=bicubic",
      "-pix_fmt", "yuv420p",
      "-c:v",     job.codec.encoder,
      "-crf",     std::to_string(job.crf)};
  out.insert(out.end(), job.codec.options.begin(), job.codec.options.end());
  out.push_back(file);
  return out;
}

bool write_picture(const Picture& picture, ChildProcess& ffmpeg) {
  return ffmpeg.write(picture.y.samples) && ffmpeg.write(picture.u.samples) &&
         ffmpeg.write(picture.v.samples);
}

/// Passes on the pictures of the source that the variant codes.
Result<void> feed(SourcePart& source, const PeerJob& job, ChildProcess& ffmpeg) {
  Progress progress("coding " + peer_label(job.codec, job.variant, job.crf), source.frame_count_estimate(),
                    job.quiet);
  for (std::int64_t n = 0;; ++n) {
    auto picture = source.next();
    if (!picture) return fail(picture.error());
    if (!*picture) return {};
    // If ffmpeg takes no more, its exit says why.
    if (n % job.variant.step == 0 && !write_picture((*picture)->picture, ffmpeg)) return {};
    progress.update(n + 1);
  }
}

Result<void> encode_to(const std::string& unfinished, const std::string& name, const PartLimits& limits,
                       const PeerJob& job, const StopSignal* stop) {
  SourceOptions options;
  options.stop = stop;
  auto opened = open_video_source(name, options);
  if (!opened) return fail(opened.error());
  SourcePart source(std::move(*opened), limits, stop);
  auto ffmpeg = ChildProcess::start(command_of(source.format(), job, unfinished),
                                    ChildProcess::Pipe::kToStandardInput, job.file + ".log");
  if (!ffmpeg) return fail(ffmpeg.error());
  if (auto fed = feed(source, job, *ffmpeg); !fed) return fed;
  if (stop != nullptr && stop->raised()) return fail(ErrorCode::kIo, job.file + ": stopped");
  if (auto finished = ffmpeg->finish(); !finished)
    return fail(ErrorCode::kIo,
                finished.error().text + " (coding " + name + " with " + job.codec.encoder + ")");
  std::error_code error;
  fs::rename(unfinished, job.file, error);
  if (error) return fail(ErrorCode::kIo, "cannot write " + job.file + ": " + error.message());
  return {};
}

std::uint32_t little_endian_32(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | bytes[at + i];
  return value;
}

}  // namespace

Result<void> encode_peer(const std::string& source, const PartLimits& limits, const PeerJob& job,
                         const StopSignal* stop) {
  const std::string unfinished = job.file + ".part";
  auto encoded = encode_to(unfinished, source, limits, job, stop);
  std::error_code ignored;
  if (!encoded) fs::remove(unfinished, ignored);
  return encoded;
}

Result<std::uint64_t> packet_bytes(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in && bytes.empty()) return fail(ErrorCode::kIo, file + ": cannot read");
  if (!file.ends_with(".ivf")) return bytes.size();
  // A header of 32 bytes; before each frame its length, 4 bytes, and its time, 8 bytes.
  constexpr std::size_t kHeader = 32, kFrameHeader = 12;
  std::uint64_t sum = 0;
  std::size_t at = kHeader;
  while (at < bytes.size()) {
    if (bytes.size() - at < kFrameHeader)
      return fail(ErrorCode::kInvalidStream, file + ": ends inside a frame");
    const std::size_t length = little_endian_32(bytes, at);
    at += kFrameHeader;
    if (length > bytes.size() - at) return fail(ErrorCode::kInvalidStream, file + ": ends inside a frame");
    const bool has_delimiter = length >= 2 && bytes[at] == 0x12 && bytes[at + 1] == 0;
    sum += length - (has_delimiter ? 2 : 0);
    at += length;
  }
  return sum;
}

}  // namespace fbs::cli
