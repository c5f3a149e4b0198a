#include "cli/evaluate/peers/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <system_error>
#include <utility>

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX leaves it to the program

namespace fbs::cli {
namespace {

std::string last_line(const std::string& file) {
  std::ifstream in(file);
  std::string line, last;
  while (std::getline(in, line))
    if (!line.empty()) last = line;
  for (char& c : last)
    if (c < ' ') c = ' ';
  return last;
}

std::vector<char*> pointers(std::vector<std::string>& command) {
  std::vector<char*> out;
  out.reserve(command.size() + 1);
  for (std::string& word : command) out.push_back(word.data());
  out.push_back(nullptr);
  return out;
}

/// posix_spawnp() with `pipe` as one standard stream; the others are null and the log.
int spawn(std::vector<std::string> command, int pipe, bool to_child, const std::string& log, pid_t& id) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  const int ours = to_child ? STDIN_FILENO : STDOUT_FILENO, other = to_child ? STDOUT_FILENO : STDIN_FILENO;
  posix_spawn_file_actions_adddup2(&actions, pipe, ours);
  posix_spawn_file_actions_addopen(&actions, other, "/dev/null", O_RDWR, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.empty() ? "/dev/null" : log.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0666);
  std::vector<char*> words = pointers(command);
  const int error = posix_spawnp(&id, words.front(), &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

}  // namespace

Result<ChildProcess> ChildProcess::start(const std::vector<std::string>& command, Pipe pipe,
                                         const std::string& log) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    return fail(ErrorCode::kIo,
                command.front() + ": cannot start: " + std::generic_category().message(errno));
  pid_t id = 0;
  const bool to_child = pipe == Pipe::kToStandardInput;
  const int error = spawn(command, ends[1], to_child, log, id);
  ::close(ends[1]);
  ChildProcess child(error == 0 ? id : 0, ends[0], command.front(), log);
  if (error != 0)
    return fail(ErrorCode::kIo,
                command.front() + ": cannot start: " + std::generic_category().message(error));
  return child;
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : id_(std::exchange(other.id_, 0)),
      pipe_(std::exchange(other.pipe_, -1)),
      name_(std::move(other.name_)),
      log_(std::move(other.log_)) {}

ChildProcess::~ChildProcess() {
  close_pipe();
  if (id_ == 0) return;
  kill(id_, SIGKILL);
  while (waitpid(id_, nullptr, 0) < 0 && errno == EINTR) continue;
}

void ChildProcess::close_pipe() {
  if (pipe_ >= 0) ::close(pipe_);
  pipe_ = -1;
}

bool ChildProcess::write(std::span<const std::uint8_t> bytes) const {
  while (!bytes.empty()) {
    const ssize_t n = send(pipe_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return true;
}

std::size_t ChildProcess::read(std::span<std::uint8_t> bytes) const {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::read(pipe_, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    done += static_cast<std::size_t>(n);
  }
  return done;
}

Result<void> ChildProcess::finish() {
  close_pipe();
  int status = 0;
  while (waitpid(id_, &status, 0) < 0 && errno == EINTR) continue;
  id_ = 0;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  const std::string said = log_.empty() ? "" : last_line(log_);
  return fail(ErrorCode::kIo, name_ + " failed" + (said.empty() ? "" : ": " + said));
}

std::string output_of(const std::vector<std::string>& command) {
  auto child = ChildProcess::start(command, ChildProcess::Pipe::kFromStandardOutput, "");
  if (!child) return {};
  std::string out;
  std::array<std::uint8_t, 1 << 14> buffer{};
  while (const std::size_t n = child->read(buffer))
    out.append(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(n));
  return child->finish() ? out : std::string();
}

}  // namespace fbs::cli
