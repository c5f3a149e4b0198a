#include "cli/stream_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace fbs::cli {

StreamFile::Descriptor::~Descriptor() {
  if (number_ > STDIN_FILENO) ::close(number_);
}

Result<StreamFile> StreamFile::open(const std::string& name, const StopSignal* stop) {
  if (name == "-") return StreamFile("standard input", Descriptor(STDIN_FILENO), stop);
  Descriptor file(::open(name.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.number() < 0)
    return fail(ErrorCode::kIo, name + ": cannot open: " + std::generic_category().message(errno));
  struct stat status {};
  if (fstat(file.number(), &status) == 0 && S_ISDIR(status.st_mode))
    return fail(ErrorCode::kIo, name + ": cannot read: is a directory");
  return StreamFile(name, std::move(file), stop);
}

Result<DecodeStatus> StreamFile::next() {
  for (;;) {
    auto status = decoder_.next();
    if (!status) return fail(about_file(name_, status.error()));
    if (*status != DecodeStatus::kNeedMore) return status;
    std::array<std::uint8_t, 1 << 16> buffer;
    const ssize_t n = ::read(file_.number(), buffer.data(), buffer.size());
    if (n > 0)
      decoder_.feed(std::span(buffer).first(n));
    else if (n == 0)
      decoder_.close();
    else if (errno != EINTR || (stop_ != nullptr && stop_->raised()))
      return fail(ErrorCode::kIo, name_ + ": cannot read: " + std::generic_category().message(errno));
  }
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
