#include "cli/stream_file.h"

#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace fbs::cli {

void StreamFile::Closer::operator()(std::FILE* f) const {
  if (f != stdin) std::fclose(f);
}

Result<StreamFile> StreamFile::open(const std::string& name) {
  if (name == "-") return StreamFile("standard input", std::unique_ptr<std::FILE, Closer>(stdin));
  std::unique_ptr<std::FILE, Closer> file(std::fopen(name.c_str(), "rb"));
  if (!file) return fail(ErrorCode::kIo, name + ": cannot open: " + std::strerror(errno));
  struct stat status {};
  if (fstat(fileno(file.get()), &status) == 0 && S_ISDIR(status.st_mode))
    return fail(ErrorCode::kIo, name + ": cannot read: it is a folder");
  return StreamFile(name, std::move(file));
}

Result<DecodeStatus> StreamFile::next() {
  for (;;) {
    auto status = decoder_.next();
    if (!status) return tl::unexpected<Error>(about_file(name_, status.error()));
    if (*status != DecodeStatus::kNeedMore) return status;
    std::array<std::uint8_t, 1 << 16> buffer;
    const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), file_.get());
    if (n > 0) decoder_.feed(std::span(buffer.data(), n));
    else if (std::ferror(file_.get()) != 0) return fail(ErrorCode::kIo, name_ + ": cannot read: " + std::strerror(errno));
    else decoder_.close();
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
