// Another program that reads or writes pictures through a pipe: ffmpeg.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/result.h"

namespace fbs::cli {

/// A running program with one of its standard streams connected to us. Its standard error goes to a file.
class ChildProcess {
 public:
  enum class Pipe : std::uint8_t { kToStandardInput, kFromStandardOutput };

  /// @param command  the program, found in PATH, and its arguments
  /// @param log      file for its standard error, replaced; empty: none
  /// @return kIo, with the name of the program, when it cannot be started
  static Result<ChildProcess> start(const std::vector<std::string>& command, Pipe pipe,
                                    const std::string& log);

  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&&) = delete;
  /// Ends the program if finish() has not waited for it.
  ~ChildProcess();

  /// @return false when the program accepts no more; finish() says why
  [[nodiscard]] bool write(std::span<const std::uint8_t> bytes) const;
  /// Fills `bytes` as far as the program writes enough.
  /// @return number of bytes
  [[nodiscard]] std::size_t read(std::span<std::uint8_t> bytes) const;

  /// Closes the pipe and waits for the end of the program.
  /// @return kIo with the last line of its standard error unless its exit code is 0
  Result<void> finish();

 private:
  ChildProcess(pid_t id, int pipe, std::string name, std::string log)
      : id_(id), pipe_(pipe), name_(std::move(name)), log_(std::move(log)) {}
  void close_pipe();

  pid_t id_;  ///< 0: has ended
  int pipe_;  ///< a socket: writing to a closed one raises no signal; -1: closed
  std::string name_, log_;
};

/// Runs a program to its end.
/// @return what it wrote to its standard output; nothing when it failed or cannot be started
[[nodiscard]] std::string output_of(const std::vector<std::string>& command);

}  // namespace fbs::cli
