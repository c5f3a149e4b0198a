// A file that appears under its name only when it is complete.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/result.h"

namespace fbs {

/// Writes `NAME.part` beside the final name and renames it in commit(); without commit() the destructor
/// removes it. The part is locked until then: a second writer of the same name gets an error. One that a
/// process left behind is replaced. A symbolic link keeps pointing where it did: its target is replaced.
/// Pipes and devices
/// (`/dev/null`) are written directly. All errors are ErrorCode::kIo, "cannot write NAME: " and the system's
/// reason.
class AtomicFile {
 public:
  static Result<AtomicFile> create(const std::string& name);

  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  ~AtomicFile();

  /// Appends at the cursor. Bytes may wait in a buffer of 256 KiB.
  Result<void> write(std::span<const std::uint8_t> bytes);

  /// Hands the buffer to the system: a program that is killed afterwards loses none of it.
  Result<void> flush();

  /// Moves the cursor, for containers that write sizes last.
  /// @param offset  bytes from the start of the file
  Result<void> seek(std::uint64_t offset);

  /// Whether an earlier run had left a part behind.
  [[nodiscard]] bool replaced_leftover() const { return replaced_leftover_; }

  /// False for pipes and terminals, where seek fails.
  [[nodiscard]] bool seekable() const { return !direct_; }

  /// Writes out the buffer and closes the file, still under its `.part` name: for sets of files that must
  /// appear together.
  Result<void> close();

  /// Releases the lock, and with it a descriptor, before commit(): for all but the first of a large set.
  void unlock() noexcept;

  /// Closes if needed, and renames. Call once.
  Result<void> commit();

  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  AtomicFile() = default;

  Result<void> write_through(std::span<const std::uint8_t> bytes);
  [[nodiscard]] tl::unexpected<Error> system_error(int code) const;
  void discard() noexcept;

  std::string name_;     ///< as the user gave it
  std::string target_;   ///< the same after following links
  std::string partial_;  ///< name of the file being written; empty when there is nothing to remove
  int descriptor_ = -1;
  int lock_ = -1;  ///< a copy of descriptor_, open until the part is renamed or removed
  bool replaced_leftover_ = false;
  bool direct_ = false;               ///< a pipe or device: no renaming
  std::vector<std::uint8_t> buffer_;  ///< bytes to be written at the cursor
};

}  // namespace fbs
