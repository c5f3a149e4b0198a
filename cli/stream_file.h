// A stream read from a file or a pipe, a piece at a time.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

#include "decoder/stream_decoder.h"

namespace fbs::cli {

/// Reads `name` (`-`: standard input) into a decoder as the decoder asks for it. Errors name the file and, where the
/// stream is damaged, the byte.
class StreamFile {
 public:
  static Result<StreamFile> open(const std::string& name);

  /// As StreamDecoder::next(), never kNeedMore.
  Result<DecodeStatus> next();

  [[nodiscard]] StreamDecoder& decoder() { return decoder_; }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  struct Closer {
    void operator()(std::FILE* f) const;
  };
  StreamFile(std::string name, std::unique_ptr<std::FILE, Closer> file) : name_(std::move(name)), file_(std::move(file)) {}

  std::string name_;
  std::unique_ptr<std::FILE, Closer> file_;
  StreamDecoder decoder_;
};

/// "NAME: text" or "NAME: text (at byte N)".
[[nodiscard]] Error about_file(const std::string& name, const Error& error);

}  // namespace fbs::cli
