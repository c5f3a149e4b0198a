// A stream read piecewise from a file or a pipe.
#pragma once

#include <string>
#include <utility>

#include "decoder/stream_decoder.h"

namespace fbs::cli {

/// Reads `name` (`-`: standard input) into a decoder on demand. Errors name the file and, where the stream is
/// damaged, the byte.
class StreamFile {
 public:
  static Result<StreamFile> open(const std::string& name);

  /// StreamDecoder::next() with all the bytes that it needs: never kNeedMore.
  Result<DecodeStatus> next();

  [[nodiscard]] StreamDecoder& decoder() { return decoder_; }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  /// A file descriptor, closed by the destructor unless it is standard input.
  class Descriptor {
   public:
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&&) = delete;
    ~Descriptor();
    [[nodiscard]] int number() const { return number_; }

   private:
    int number_;
  };
  StreamFile(std::string name, Descriptor file) : name_(std::move(name)), file_(std::move(file)) {}

  std::string name_;
  Descriptor file_;  ///< not a FILE, which would wait for a full buffer before passing on what a pipe has
  StreamDecoder decoder_;
};

/// "NAME: text" or "NAME: text (at byte N)".
[[nodiscard]] Error about_file(const std::string& name, const Error& error);

}  // namespace fbs::cli
