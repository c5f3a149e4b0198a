#include "cli/play/pipe_peek.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>

namespace fbs::cli {
namespace {

constexpr std::size_t kMost = 1 << 16;  ///< capacity of a pipe

}  // namespace

PipePeek::PipePeek(const std::string& name)
    : source_(name == "-" ? ::dup(STDIN_FILENO) : ::open(name.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
  if (::pipe(copy_) != 0) copy_[0] = copy_[1] = -1;
}

PipePeek::~PipePeek() {
  for (const int descriptor : {source_, copy_[0], copy_[1]})
    if (descriptor >= 0) ::close(descriptor);
}

std::vector<std::uint8_t> PipePeek::bytes() const {
  std::vector<std::uint8_t> out(kMost);
  ssize_t count = -1;
#ifdef __linux__
  count = ::tee(source_, copy_[1], kMost, SPLICE_F_NONBLOCK);
  if (count > 0) count = ::read(copy_[0], out.data(), static_cast<std::size_t>(count));
#endif
  if (count < 0)
    count = ::recv(source_, out.data(), kMost, MSG_PEEK | MSG_DONTWAIT);  // fails if it is not a socket
  out.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  return out;
}

}  // namespace fbs::cli
