// What has come in a pipe and has not been read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace fbs::cli {

/// Looks at the bytes that whoever reads the same pipe, FIFO or socket will get next, and leaves them there.
class PipePeek {
 public:
  /// @param name  of the pipe, or `-`: standard input
  explicit PipePeek(const std::string& name);
  PipePeek(const PipePeek&) = delete;
  PipePeek& operator=(const PipePeek&) = delete;
  ~PipePeek();

  /// The bytes that are there now, in order; at most 64 KiB. None where the system cannot tell.
  [[nodiscard]] std::vector<std::uint8_t> bytes() const;

 private:
  int source_;           ///< file descriptor; -1: none
  int copy_[2]{-1, -1};  ///< a pipe of our own: where tee(2) copies to
};

}  // namespace fbs::cli
