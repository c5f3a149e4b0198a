// Checks of outputs: their names, before anything is opened for writing, what was in their way, and that what
// is printed arrives.
#pragma once

#include <span>
#include <string>

#include "common/result.h"

namespace fbs::cli {

/// A file on the command line, with its name in errors.
struct NamedFile {
  std::string role;  ///< such as "INPUT" or "--overlay"
  std::string name;  ///< as given; `-` is standard input or output; empty: not given
};

/// Refuses outputs that are an input, or the same as each other, after following links: by device and inode
/// where they exist, else by name. Pipes and devices may be shared.
/// @return ErrorCode::kInvalidArgument, which names both
Result<void> check_distinct(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs);

/// A stream goes to a name that ends in `.fbs`, to `-`, or to a pipe or device.
/// @return ErrorCode::kUnsupported for other names, with one that would do
Result<void> check_stream_name(const std::string& output);

/// Whether the name denotes a pipe or device, or one of the program's open files.
[[nodiscard]] bool is_device(const std::string& name);

/// ".mp4" of "talk.MP4"; empty when there is none.
std::string extension_of(const std::string& name);

/// @return ErrorCode::kUnsupported for a name that ends in `.fbs`: pictures are not a stream
Result<void> check_picture_name(const std::string& output);

/// Says on standard error that `OUTPUT.part` of an earlier run was replaced.
void print_replaced_leftover(const std::string& output);

/// Writes out what has been printed: a full disk is noticed only then.
/// @return kIo when it, or anything printed earlier, could not be written
[[nodiscard]] Result<void> flush_standard_output();

}  // namespace fbs::cli
