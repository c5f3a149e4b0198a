// The file `NAME.part` that becomes NAME when it is complete, locked while a process writes it.
#pragma once

#include <sys/types.h>

#include <string>

#include "common/result.h"

namespace fbs {

struct PartialFile {
  int descriptor = -1;    ///< for writing; the file is locked until it and its copies are closed
  bool replaced = false;  ///< a file of that name was left by a process that has ended
};

/// Creates `path` with an advisory lock (flock). An existing file that is not locked is removed first, never
/// written into; symbolic links are not followed. On file systems without locks there is no locking.
/// @return the error code of the system; EBUSY when another process writes the file
tl::expected<PartialFile, int> create_partial_file(const std::string& path, mode_t mode);

}  // namespace fbs
