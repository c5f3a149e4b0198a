// Where `export` and `track` write their tables.
#pragma once

#include <optional>
#include <string>

#include "cli/files/atomic_file.h"
#include "common/result.h"
#include "decoder/export/face_table.h"

namespace fbs::cli {

/// The format of a table.
/// @param output  name of the file, which ends in .csv or .json, or `-`
/// @param format  --format: "csv", "json" or, if it was not given, empty
/// @return nullopt for a name that is no table's; CSV for `-` without a format; kInvalidArgument where the
/// name says one format and `format` another
[[nodiscard]] Result<std::optional<TableFormat>> table_format(const std::string& output,
                                                              const std::string& format);

/// A table in a file that gets its name when it is complete, or on standard output.
class TableOutput {
 public:
  static Result<TableOutput> create(const std::string& output, TableFormat format);

  Result<void> begin(const VideoFormat& video) { return write(table_.begin(video)); }
  Result<void> add(const FaceRow& row) { return write(table_.row(row)); }
  /// Completes the table. Call once, last.
  Result<void> finish();

 private:
  TableOutput(std::optional<AtomicFile> file, TableFormat format) : file_(std::move(file)), table_(format) {}
  Result<void> write(const std::string& text);

  std::optional<AtomicFile> file_;  ///< none: standard output
  FaceTable table_;
};

}  // namespace fbs::cli
