#include "cli/files/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

#include "cli/files/partial_file.h"

namespace fbs {
namespace {

constexpr std::size_t kBufferSize = 256 * 1024;
constexpr mode_t kNewFileMode = 0666;  // before the umask

/// The name after following symbolic links; the name itself when there is no such file yet.
std::string follow_links(const std::string& name) {
  std::error_code missing;
  const std::filesystem::path real = std::filesystem::canonical(name, missing);
  return missing ? name : real.string();
}

}  // namespace

Result<AtomicFile> AtomicFile::create(const std::string& name) {
  AtomicFile file;
  file.name_ = name;
  if (name == "-") {
    file.name_ = "standard output";
    file.direct_ = true;
    file.descriptor_ = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
    if (file.descriptor_ < 0) return file.system_error(errno);
    return file;
  }
  file.target_ = follow_links(name);

  struct stat existing {};
  const bool exists = stat(file.target_.c_str(), &existing) == 0;
  if (exists && S_ISDIR(existing.st_mode)) return file.system_error(EISDIR);
  if (exists && access(file.target_.c_str(), W_OK) != 0) return file.system_error(errno);
  if (exists && !S_ISREG(existing.st_mode)) {
    file.direct_ = true;
    file.descriptor_ = open(file.target_.c_str(), O_WRONLY | O_CLOEXEC);
    if (file.descriptor_ < 0) return file.system_error(errno);
    return file;
  }

  const std::string partial = file.target_ + ".part";
  const auto made = create_partial_file(partial, kNewFileMode);
  if (!made && made.error() == EBUSY)
    return fail(ErrorCode::kIo, "cannot write " + name + ": another process is writing " + partial);
  if (!made) return file.system_error(made.error());
  file.descriptor_ = made->descriptor;
  file.lock_ = fcntl(file.descriptor_, F_DUPFD_CLOEXEC, 0);
  file.replaced_leftover_ = made->replaced;
  file.partial_ = partial;
  if (file.lock_ < 0) return file.system_error(errno);
  if (exists && fchmod(file.descriptor_, existing.st_mode & 0777) != 0) return file.system_error(errno);
  return file;
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : name_(std::move(other.name_)),
      target_(std::move(other.target_)),
      partial_(std::exchange(other.partial_, {})),
      descriptor_(std::exchange(other.descriptor_, -1)),
      lock_(std::exchange(other.lock_, -1)),
      replaced_leftover_(other.replaced_leftover_),
      direct_(other.direct_),
      buffer_(std::exchange(other.buffer_, {})) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  if (this == &other) return *this;
  discard();
  name_ = std::move(other.name_);
  target_ = std::move(other.target_);
  partial_ = std::exchange(other.partial_, {});
  descriptor_ = std::exchange(other.descriptor_, -1);
  lock_ = std::exchange(other.lock_, -1);
  replaced_leftover_ = other.replaced_leftover_;
  direct_ = other.direct_;
  buffer_ = std::exchange(other.buffer_, {});
  return *this;
}

AtomicFile::~AtomicFile() {
  discard();
}

Result<void> AtomicFile::write(std::span<const std::uint8_t> bytes) {
  assert(descriptor_ >= 0);
  if (bytes.size() > kBufferSize - buffer_.size()) {
    if (auto flushed = flush(); !flushed) return flushed;
  }
  if (bytes.size() >= kBufferSize) return write_through(bytes);
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  return {};
}

Result<void> AtomicFile::seek(std::uint64_t offset) {
  if (direct_) return system_error(ESPIPE);
  if (auto flushed = flush(); !flushed) return flushed;
  if (lseek(descriptor_, static_cast<off_t>(offset), SEEK_SET) < 0) return system_error(errno);
  return {};
}

Result<void> AtomicFile::close() {
  if (descriptor_ < 0) return {};
  if (auto flushed = flush(); !flushed) return flushed;
  buffer_ = {};
  // Some file systems report a full disk only here.
  if (::close(std::exchange(descriptor_, -1)) != 0) return system_error(errno);
  return {};
}

Result<void> AtomicFile::commit() {
  if (auto closed = close(); !closed) return closed;
  if (direct_) return {};
  assert(!partial_.empty());
  if (std::rename(partial_.c_str(), target_.c_str()) != 0) return system_error(errno);
  partial_.clear();
  unlock();
  return {};
}

void AtomicFile::unlock() noexcept {
  if (lock_ >= 0) ::close(lock_);
  lock_ = -1;
}

Result<void> AtomicFile::flush() {
  auto written = write_through(buffer_);
  buffer_.clear();
  return written;
}

Result<void> AtomicFile::write_through(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return system_error(errno);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return {};
}

tl::unexpected<Error> AtomicFile::system_error(int code) const {
  return fail(ErrorCode::kIo, "cannot write " + name_ + ": " + std::generic_category().message(code));
}

void AtomicFile::discard() noexcept {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
  if (!partial_.empty()) unlink(partial_.c_str());
  partial_.clear();
  unlock();
}

}  // namespace fbs
