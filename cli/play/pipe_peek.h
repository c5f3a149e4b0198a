// Looks at the unread bytes of a pipe.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace fbs::cli {

/// Looks at the next bytes for any reader of the same pipe, FIFO or socket, without taking them.
class PipePeek {
 public:
  /// @param name  of the pipe, or `-`: standard input
  explicit PipePeek(const std::string& name);
  PipePeek(const PipePeek&) = delete;
  PipePeek& operator=(const PipePeek&) = delete;
  ~PipePeek();

  /// The bytes there now, in order; at most 64 KiB. None where the system cannot tell.
  [[nodiscard]] std::vector<std::uint8_t> bytes() const;

 private:
  int source_;           ///< file descriptor; -1: none
  int copy_[2]{-1, -1};  ///< our own pipe, to which tee(2) copies
};

}  // namespace fbs::cli
