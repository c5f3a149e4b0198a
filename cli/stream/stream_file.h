// A stream read piecewise from a file or a pipe.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cli/files/stop_signal.h"
#include "decoder/stream/stream_decoder.h"

namespace fbs::cli {

/// Reads `name` (`-`: standard input) into a decoder on demand. Errors name the file and, where the stream is
/// damaged, the byte. From a Matroska file it reads the stream inside, in which bytes are counted.
class StreamFile {
 public:
  /// @param stop  must outlive the object; null: reading is never stopped
  static Result<StreamFile> open(const std::string& name, const StopSignal* stop = nullptr);

  /// StreamDecoder::next() with all the bytes that it needs: never kNeedMore. ErrorCode::kIo when the signal
  /// comes while it waits for bytes; after seek() kInvalidArgument if the stream ends before that time.
  Result<DecodeStatus> next();

  /// Joins the stream at the last scene that begins at or before `time`; next() leaves out pictures that end
  /// before. Reads the whole stream into memory. Only before the first next().
  /// @param time  1/90000 s, as in StreamDecoder::position()
  Result<void> seek(std::uint64_t time);

  /// Keeps a copy of everything read from now on, for rejoin(). Only before the first next() or seek().
  void keep_bytes() { kept_.emplace(); }

  /// Goes to another time in the part read, or beyond: like seek(), but on the bytes of keep_bytes(), and any
  /// number of times. decoder() starts anew.
  void rejoin(std::uint64_t time);

  /// Calls `idle` every kIdle while waiting for bytes. If it returns false, next() ends with kIo.
  void on_wait(std::function<bool()> idle) { idle_ = std::move(idle); }
  static constexpr std::chrono::milliseconds kIdle{20};

  /// Bytes of the stream up to where the decoder has read.
  [[nodiscard]] std::uint64_t bytes_decoded() const { return skipped_ + decoder_.bytes().total; }
  /// Bytes that keep_bytes() has kept.
  [[nodiscard]] std::span<const std::uint8_t> kept() const {
    return kept_ ? std::span<const std::uint8_t>(*kept_) : std::span<const std::uint8_t>();
  }

  /// Reads the rest without feeding it to the decoder.
  Result<std::vector<std::uint8_t>> read_all();

  [[nodiscard]] StreamDecoder& decoder() { return decoder_; }
  [[nodiscard]] const StreamDecoder& decoder() const { return decoder_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] bool is_matroska() const { return extracted_.has_value(); }
  /// Codec IDs of the tracks of a Matroska file that are not read.
  [[nodiscard]] const std::vector<std::string>& left_out() const { return left_out_; }

 private:
  /// Whether it begins like Matroska. False for pipes, which are not read.
  [[nodiscard]] bool is_matroska_input() const;
  /// Extracts the stream from a regular file that begins like Matroska; others are left alone.
  Result<void> extract();
  /// @return number of bytes; 0 at the end
  Result<std::size_t> read(std::span<std::uint8_t> buffer);
  /// Whether there is something to read, or the end; false when idle_ asks to stop.
  [[nodiscard]] bool wait() const;
  void join(std::span<const std::uint8_t> bytes, std::uint64_t time);
  /// Feeds the decoder with the next bytes of the file.
  Result<void> read_more();

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
  StreamFile(std::string name, Descriptor file, const StopSignal* stop)
      : name_(std::move(name)), file_(std::move(file)), stop_(stop) {}

  std::string name_;
  Descriptor file_;  ///< not a FILE, which would wait for a full buffer before passing on a pipe's bytes
  const StopSignal* stop_;
  StreamDecoder decoder_;
  std::uint64_t skipped_ = 0;  ///< bytes of the file not fed to the decoder
  std::uint64_t from_ = 0;     ///< time to be reached, 1/90000 s; 0: reached
  std::optional<std::vector<std::uint8_t>> kept_;
  std::function<bool()> idle_;
  std::optional<std::vector<std::uint8_t>> extracted_;  ///< the whole stream of a Matroska file
  std::size_t extracted_read_ = 0;                      ///< bytes of it
  std::vector<std::string> left_out_;
};

/// Seconds, from 0 to 1e8, in 1/90000 s.
[[nodiscard]] std::uint64_t ticks(double seconds);

/// "NAME: text" or "NAME: text (at byte N)".
[[nodiscard]] Error about_file(const std::string& name, const Error& error);

}  // namespace fbs::cli
