#include "cli/stream/stream_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <system_error>

#include "cli/program/module.h"
#include "cli/stream/matroska_module.h"
#include "cli/video/open/open_video.h"
#include "decoder/stream/scene_index.h"

namespace fbs::cli {
namespace {

constexpr std::size_t kBufferSize = 1 << 16;

/// @param length  of the stream, 1/90000 s
Error past_the_end(const std::string& name, std::uint64_t length) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "nothing there: the stream is %.2f s long",
                static_cast<double>(length) / kTicksPerSecond);
  return {ErrorCode::kInvalidArgument, name + ": --from: " + text.data()};
}

}  // namespace

StreamFile::Descriptor::~Descriptor() {
  if (number_ > STDIN_FILENO) ::close(number_);
}

Result<StreamFile> StreamFile::open(const std::string& name, const StopSignal* stop) {
  if (name == "-") {
    StreamFile stream("standard input", Descriptor(STDIN_FILENO), stop);
    if (stream.is_matroska_input())
      return fail(ErrorCode::kUnsupported,
                  "standard input: a Matroska file is read by its name, not from standard input");
    return stream;
  }
  Descriptor file(::open(name.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.number() < 0)
    return fail(ErrorCode::kIo, name + ": cannot open: " + std::generic_category().message(errno));
  struct stat status {};
  if (fstat(file.number(), &status) == 0 && S_ISDIR(status.st_mode))
    return fail(ErrorCode::kIo, name + ": cannot read: is a directory");
  StreamFile stream(name, std::move(file), stop);
  if (S_ISREG(status.st_mode))
    if (auto extracted = stream.extract(); !extracted) return fail(extracted.error());
  return stream;
}

Result<void> StreamFile::extract() {
  if (!is_matroska_input()) return {};
  if (!is_stream_file(name_))
    return fail(ErrorCode::kUnsupported, name_ + ": is a Matroska file without fbs video (V_FBS)");
  const auto bytes = read_all();
  if (!bytes) return fail(bytes.error());
  const auto convert = load_module_function<StreamOfMatroska>(kMatroskaModule, kStreamOfMatroskaSymbol);
  if (!convert) return fail(convert.error());
  Result<MatroskaStream> stream;
  (*convert)(*bytes, stream);
  if (!stream) return fail(stream.error().code, name_ + ": " + stream.error().text);
  extracted_ = std::move(stream->bytes);
  left_out_ = std::move(stream->left_out);
  return {};
}

bool StreamFile::is_matroska_input() const {
  std::array<std::uint8_t, kEbmlHead.size()> head{};
  return ::pread(file_.number(), head.data(), head.size(), 0) == static_cast<ssize_t>(head.size()) &&
         head == kEbmlHead;
}

Result<DecodeStatus> StreamFile::next() {
  for (;;) {
    auto status = decoder_.next();
    if (!status) {
      Error error = status.error();
      error.byte_offset += skipped_;
      return fail(about_file(name_, error));
    }
    const std::uint64_t end = decoder_.position().time + decoder_.duration();
    switch (*status) {
      case DecodeStatus::kPicture:
        if (end <= from_) continue;
        from_ = 0;
        return status;
      case DecodeStatus::kEnd:
        if (from_ > 0 && decoder_.pictures() > 0) return fail(past_the_end(name_, end));
        return status;
      case DecodeStatus::kNeedMore:
        if (auto read = read_more(); !read) return fail(read.error());
    }
  }
}

Result<std::size_t> StreamFile::read(std::span<std::uint8_t> buffer) {
  if (extracted_) {
    const std::size_t n = std::min(buffer.size(), extracted_->size() - extracted_read_);
    std::copy_n(extracted_->begin() + static_cast<std::ptrdiff_t>(extracted_read_), n, buffer.begin());
    extracted_read_ += n;
    return n;
  }
  for (;;) {
    if (!wait()) return fail(ErrorCode::kIo, name_ + ": stopped");
    const ssize_t n = ::read(file_.number(), buffer.data(), buffer.size());
    if (n >= 0) return static_cast<std::size_t>(n);
    if (errno != EINTR || (stop_ != nullptr && stop_->raised()))
      return fail(ErrorCode::kIo, name_ + ": cannot read: " + std::generic_category().message(errno));
  }
}

bool StreamFile::wait() const {
  if (!idle_) return true;
  pollfd asked{file_.number(), POLLIN, 0};
  while (::poll(&asked, 1, static_cast<int>(kIdle.count())) == 0)
    if (!idle_()) return false;
  return true;  // also after an error, which read() reports
}

Result<void> StreamFile::read_more() {
  std::array<std::uint8_t, kBufferSize> buffer;
  const auto n = read(buffer);
  if (!n) return fail(n.error());
  if (kept_) kept_->insert(kept_->end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(*n));
  if (*n > 0)
    decoder_.feed(std::span(buffer).first(*n));
  else
    decoder_.close();
  return {};
}

Result<std::vector<std::uint8_t>> StreamFile::read_all() {
  std::vector<std::uint8_t> bytes;
  for (;;) {
    const std::size_t size = bytes.size();
    bytes.resize(size + kBufferSize);
    const auto n = read(std::span(bytes).subspan(size));
    if (!n) return fail(n.error());
    bytes.resize(size + *n);
    if (*n == 0) return bytes;
  }
}

Result<void> StreamFile::seek(std::uint64_t time) {
  auto bytes = read_all();
  if (!bytes) return fail(bytes.error());
  join(*bytes, time);
  if (kept_) kept_ = std::move(*bytes);
  return {};
}

void StreamFile::rejoin(std::uint64_t time) {
  decoder_ = StreamDecoder();
  skipped_ = 0;
  join(kept(), time);
}

void StreamFile::join(std::span<const std::uint8_t> bytes, std::uint64_t time) {
  const auto scenes = index_scenes(bytes);
  const SceneEntry* const scene = scene_at(scenes, time);
  if (scene != nullptr) {
    decoder_.feed(kSignature);
    skipped_ = scene->offset - kSignature.size();
  }
  decoder_.feed(bytes.subspan(scene != nullptr ? scene->offset : 0));
  from_ = time;
}

std::uint64_t ticks(double seconds) {
  return static_cast<std::uint64_t>(std::llround(seconds * kTicksPerSecond));
}

Error about_file(const std::string& name, const Error& error) {
  Error out = error;
  out.text = name + ": " + error.text;
  const bool in_stream = error.code == ErrorCode::kTruncated || error.code == ErrorCode::kInvalidStream ||
                         error.code == ErrorCode::kTooLarge;
  if (in_stream) out.text += " (at byte " + std::to_string(error.byte_offset) + ")";
  return out;
}

}  // namespace fbs::cli
