// The part of a source that is encoded: until a limit, damage or a stop signal.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "cli/files/stop_signal.h"
#include "cli/video/video_source.h"

namespace fbs::cli {

/// Whichever is reached first; nullopt: no limit.
struct PartLimits {
  std::optional<std::int64_t> pictures;  ///< at least 1
  std::optional<double> seconds;         ///< of source time from the first picture on, above 0
};

/// A source that ends cleanly at its limits, where it is truncated or damaged, and when the program is asked
/// to stop. Reads no picture after the last, except one with a limit of seconds.
class SourcePart final : public VideoSource {
 public:
  /// @param stop  must outlive the object; null: nothing stops it
  SourcePart(std::unique_ptr<VideoSource> source, const PartLimits& limits, const StopSignal* stop);

  [[nodiscard]] const VideoFormat& format() const override { return source_->format(); }
  Result<std::optional<TimedPicture>> next() override;
  [[nodiscard]] bool is_ready(std::chrono::milliseconds patience) const override {
    return ended_ || source_->is_ready(patience);
  }
  [[nodiscard]] bool has_constant_rate() const override { return source_->has_constant_rate(); }
  /// The limits are an estimate where the source has none.
  [[nodiscard]] std::optional<std::int64_t> frame_count_estimate() const override;
  [[nodiscard]] std::optional<double> seconds_estimate() const override;
  [[nodiscard]] std::int64_t damaged_packets() const override { return source_->damaged_packets(); }
  [[nodiscard]] std::vector<std::string> notes() const override { return source_->notes(); }

  /// The error that ended the source after at least one picture; nullopt: none.
  [[nodiscard]] const std::optional<Error>& failure() const { return failure_; }
  /// No failure, and no damaged packets.
  [[nodiscard]] bool is_whole() const { return !failure_ && damaged_packets() == 0; }

 private:
  /// The end, or the error if it is to be passed on.
  Result<std::optional<TimedPicture>> end_by(const Error& error);
  /// Most pictures that the limits allow, at the frame rate; nullopt: there are none.
  [[nodiscard]] std::optional<std::int64_t> most_pictures() const;
  [[nodiscard]] bool stopped() const { return stop_ != nullptr && stop_->raised(); }
  [[nodiscard]] bool within_seconds(std::int64_t pts);

  std::unique_ptr<VideoSource> source_;
  PartLimits limits_;
  const StopSignal* stop_;
  std::int64_t pictures_ = 0;              ///< returned so far
  std::optional<std::int64_t> first_pts_;  ///< 1/90000 s
  std::optional<Error> failure_;
  bool ended_ = false;
};

/// An error about a source: names it unless it names its file already.
[[nodiscard]] Error about_input(Error error, const std::string& name);

/// Opens `name` (open_video_source()) up to its limits.
/// @param sequence_rate  pictures per second of image sequences, 25 if none is given; refused for other
/// sources
/// @param rotate  SourceOptions::rotate
[[nodiscard]] Result<SourcePart> open_source_part(const std::string& name, const PartLimits& limits,
                                                  std::optional<double> sequence_rate, int rotate,
                                                  const StopSignal& stop);

/// Says a source's notes() on standard error.
void print_notes(const std::string& name, const VideoSource& source);

/// Says on standard error that a source is not whole, and its notes().
/// @param pictures  that were read
/// @param done      what happened to them: "encoded"
/// @param quiet     no notes
void print_source_warning(const std::string& name, const SourcePart& source, std::uint64_t pictures,
                          const char* done, bool quiet);

}  // namespace fbs::cli
