#include "cli/export/table_output.h"

#include <cstdio>

#include "cli/files/output_check.h"

namespace fbs::cli {

Result<std::optional<TableFormat>> table_format(const std::string& output, const std::string& format) {
  std::optional<TableFormat> asked, named;
  if (format == "csv" || format == "json") asked = format == "json" ? TableFormat::kJson : TableFormat::kCsv;
  if (output == "-") return asked.value_or(TableFormat::kCsv);
  if (output.ends_with(".csv")) named = TableFormat::kCsv;
  if (output.ends_with(".json")) named = TableFormat::kJson;
  if (!format.empty() && (!asked || asked != named))
    return fail(ErrorCode::kInvalidArgument,
                output + ": --format " + format + " needs a name that ends in ." + format + ", or -");
  return named;
}

Result<TableOutput> TableOutput::create(const std::string& output, TableFormat format) {
  if (output == "-") return TableOutput(std::nullopt, format);
  auto file = AtomicFile::create(output);
  if (!file) return fail(file.error());
  if (file->replaced_leftover()) print_replaced_leftover(output);
  return TableOutput(std::move(*file), format);
}

Result<void> TableOutput::write(const std::string& text) {
  if (file_) return file_->write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size()) return {};
  return flush_standard_output();
}

Result<void> TableOutput::finish() {
  if (auto written = write(table_.end()); !written) return written;
  return file_ ? file_->commit() : flush_standard_output();
}

}  // namespace fbs::cli
