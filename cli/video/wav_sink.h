// A WAV file of 16-bit samples.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "cli/files/atomic_file.h"
#include "common/result.h"

namespace fbs {

/// Format: Microsoft and IBM, Multimedia Programming Interface and Data Specifications 1.0, 1991: PCM with a
/// header of 44 bytes. No file has its final name before finish(). In pipes, and above 4 GiB, the sizes in
/// the header are 0xFFFFFFFF, which readers take as "to the end". Errors name the output.
class WavSink {
 public:
  /// @param name  `-`: standard output
  /// @param sample_rate  Hz, above 0
  /// @param channels     1..8
  /// @return ErrorCode::kIo when it cannot be created
  static Result<std::unique_ptr<WavSink>> create(const std::string& name, int sample_rate, int channels);

  /// @param samples  interleaved, whole sample frames
  Result<void> write(std::span<const std::int16_t> samples);

  /// Completes the header and gives the file its name. Call once, last.
  Result<void> finish();

  /// Whether an unfinished file of an earlier run was replaced.
  [[nodiscard]] bool replaced_leftover() const { return file_.replaced_leftover(); }

 private:
  WavSink(AtomicFile file, int sample_rate, int channels)
      : file_(std::move(file)), sample_rate_(sample_rate), channels_(channels) {}
  Result<void> write_header(std::uint64_t data_bytes);

  AtomicFile file_;
  int sample_rate_;
  int channels_;
  std::uint64_t data_bytes_ = 0;
};

}  // namespace fbs
