#include "cli/stream/matroska_module.h"

#include <ebml/EbmlVersion.h>
#include <matroska/KaxVersion.h>

#include <algorithm>
#include <string>
#include <utility>

#include "cli/matroska/matroska_reader.h"
#include "cli/matroska/matroska_writer.h"
#include "cli/matroska/stream_mapping.h"
#include "cli/program/module.h"

namespace fbs::cli {
namespace {

Result<MatroskaStream> read_stream(std::span<const std::uint8_t> file) {
  auto read = read_matroska(file);
  if (!read) return fail(read.error());
  auto bytes = of_matroska(read->content);
  if (!bytes) return fail(bytes.error());
  return MatroskaStream{std::move(*bytes), std::move(read->left_out)};
}

Result<MatroskaFile> write_stream(std::span<const std::uint8_t> stream, const std::string& application) {
  const auto content = to_matroska(stream);
  if (!content) return fail(content.error());
  auto bytes = write_matroska(*content, application);
  if (!bytes) return fail(bytes.error());
  const auto back = read_stream(*bytes);
  if (!back) return fail(ErrorCode::kInternal, "cannot read what was written: " + back.error().text);
  if (!std::ranges::equal(back->bytes, stream))
    return fail(ErrorCode::kInternal, "would not come back the same");
  return MatroskaFile{std::move(*bytes), content->sound.has_value(), has_sound_inside(content->video)};
}

}  // namespace
}  // namespace fbs::cli

FBS_MODULE_EXPORT void fbs_stream_to_matroska(std::span<const std::uint8_t> stream,
                                              const std::string& application,
                                              fbs::Result<fbs::cli::MatroskaFile>& file) {
  file = fbs::cli::write_stream(stream, application);
}

FBS_MODULE_EXPORT void fbs_stream_of_matroska(std::span<const std::uint8_t> file,
                                              fbs::Result<fbs::cli::MatroskaStream>& stream) {
  stream = fbs::cli::read_stream(file);
}

FBS_MODULE_EXPORT const char* fbs_module_libraries() {
  static const std::string text =
      "libebml " + libebml::EbmlCodeVersion + "\nlibmatroska " + libmatroska::KaxCodeVersion;
  return text.c_str();
}
