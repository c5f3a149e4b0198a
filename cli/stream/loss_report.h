// Reports to the user what a damaged stream has lost.
#pragma once

#include <cstdint>
#include <string>

#include "cli/program/outcome.h"
#include "cli/program/progress.h"
#include "cli/stream/stream_file.h"

namespace fbs::cli {

/// Counts the damaged places of a stream that is decoded nevertheless, and summarises at the end. Prints on
/// standard error.
class LossReport {
 public:
  /// Prints at the end only.
  LossReport() = default;
  /// Prints a line for each damaged place too, the first kMaxLines of them.
  /// @param progress  ends with the first line; must outlive the object
  explicit LossReport(Progress& progress) : progress_(&progress) {}

  /// file.next(), continuing after damage.
  /// @return kPicture or kEnd; errors after which nothing can be decoded: kIo, kNotFbs, kInternal, and
  ///         kInvalidArgument for a time past the end
  Result<DecodeStatus> next(StreamFile& file);

  /// Prints the losses, if any, when the stream has ended.
  /// @return kComplete, kLittleLost or kMuchLost
  Outcome finish(StreamFile& file) const;

 private:
  static constexpr int kMaxLines = 20;

  Progress* progress_ = nullptr;
  int places_ = 0;
  std::uint64_t interpolated_ = 0, lack_patterns_ = 0;  ///< pictures, by PictureQuality
};

/// "the end packet is missing: the stream was cut after 96 pictures, or has not ended"
[[nodiscard]] std::string missing_end_text(const StreamDecoder& decoder);

}  // namespace fbs::cli
