#include "cli/evaluate/peer_encoding.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

#include "cli/encode/source_part.h"
#include "cli/evaluate/child_process.h"

namespace fbs::cli {
namespace {

namespace fs = std::filesystem;

std::string rate_text(const Rational& rate, int step) {
  return std::to_string(rate.num) + "/" + std::to_string(static_cast<std::int64_t>(rate.den) * step);
}

/// An even part of a side, as 4:2:0 encoders want it.
std::string side_text(int side, int divisor) {
  return std::to_string((side / divisor + 1) / 2 * 2);
}

std::vector<std::string> command_of(const VideoFormat& format, const PeerCodec& codec,
                                    const PeerVariant& variant, int crf, const std::string& file) {
  std::vector<std::string> out{"ffmpeg",
                               "-v",
                               "error",
                               "-y",
                               "-f",
                               "rawvideo",
                               "-pix_fmt",
                               "yuv420p",
                               "-s",
                               std::to_string(format.width) + "x" + std::to_string(format.height),
                               "-r",
                               rate_text(format.frame_rate, variant.step),
                               "-i",
                               "-",
                               "-vf",
                               "scale=" + side_text(format.width, variant.divisor) + ":" +
                                   side_text(format.height, variant.divisor) + ":flags=bicubic",
                               "-pix_fmt",
                               "yuv420p",
                               "-c:v",
                               codec.encoder,
                               "-crf",
                               std::to_string(crf)};
  out.insert(out.end(), codec.options.begin(), codec.options.end());
  out.push_back(file);
  return out;
}

bool write_picture(const Picture& picture, ChildProcess& ffmpeg) {
  return ffmpeg.write(picture.y.samples) && ffmpeg.write(picture.u.samples) &&
         ffmpeg.write(picture.v.samples);
}

std::uint32_t little_endian_32(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | bytes[at + i];
  return value;
}

}  // namespace

Result<void> encode_peer(const std::string& source, const PeerCodec& codec, const PeerVariant& variant,
                         int crf, const std::string& file, const StopSignal* stop) {
  SourceOptions options;
  options.stop = stop;
  auto opened = open_video_source(source, options);
  if (!opened) return fail(opened.error());
  SourcePart part((std::move(*opened)), {}, stop);
  const std::string unfinished = file + ".part";
  auto ffmpeg = ChildProcess::start(command_of(part.format(), codec, variant, crf, unfinished),
                                    ChildProcess::Pipe::kToStandardInput, file + ".log");
  if (!ffmpeg) return fail(ffmpeg.error());
  for (int n = 0;; ++n) {
    auto picture = part.next();
    if (!picture) return fail(picture.error());
    if (!*picture) break;
    if (n % variant.step == 0 && !write_picture((*picture)->picture, *ffmpeg)) break;
  }
  if (stop != nullptr && stop->raised()) return fail(ErrorCode::kIo, file + ": stopped");
  if (auto finished = ffmpeg->finish(); !finished)
    return fail(ErrorCode::kIo,
                finished.error().text + " (coding " + source + " with " + codec.encoder + ")");
  std::error_code error;
  fs::rename(unfinished, file, error);
  if (error) return fail(ErrorCode::kIo, "cannot write " + file + ": " + error.message());
  return {};
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
