#include "cli/files/partial_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace fbs {
namespace {

constexpr int kMaxAttempts = 20;  // other processes may create and remove the file between two calls

/// Closed by the destructor unless it was taken.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] int take() { return std::exchange(number_, -1); }

 private:
  int number_;
};

/// False when another process holds the lock.
bool lock(int descriptor) {
  return flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

/// Whether the path still leads to the open file.
bool is_at(const std::string& path, int descriptor) {
  struct stat open_file {};
  struct stat named {};
  return fstat(descriptor, &open_file) == 0 && lstat(path.c_str(), &named) == 0 &&
         open_file.st_dev == named.st_dev && open_file.st_ino == named.st_ino;
}

/// Removes a file that nobody writes. @return 0 when it is gone, or the system's error code
int remove_leftover(const std::string& path) {
  const Descriptor old(open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (old.number() < 0) return errno == ENOENT ? 0 : errno;
  if (!lock(old.number())) return EBUSY;
  // Its writer may have finished, and another begun, since it was opened.
  if (!is_at(path, old.number())) return 0;
  return unlink(path.c_str()) == 0 ? 0 : errno;
}

}  // namespace

tl::expected<PartialFile, int> create_partial_file(const std::string& path, mode_t mode) {
  PartialFile file;
  for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
    Descriptor made(open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode));
    if (made.number() < 0) {
      if (errno != EEXIST) return tl::unexpected(errno);
      if (const int error = remove_leftover(path); error != 0) return tl::unexpected(error);
      file.replaced = true;
      continue;
    }
    // Another process may have taken it for a leftover before it was locked.
    if (!lock(made.number()) || !is_at(path, made.number())) continue;
    file.descriptor = made.take();
    return file;
  }
  return tl::unexpected(EBUSY);
}

}  // namespace fbs
