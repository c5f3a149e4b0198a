// The part of a source that is encoded: until a stop signal.
#pragma once

#include <memory>
#include <utility>

#include "cli/stop_signal.h"
#include "cli/video/video_source.h"

namespace fbs::cli {

/// A source that ends cleanly when the program is asked to stop.
class SourcePart final : public VideoSource {
 public:
  /// @param stop  must outlive the object
  SourcePart(std::unique_ptr<VideoSource> source, const StopSignal& stop)
      : source_(std::move(source)), stop_(stop) {}

  [[nodiscard]] const VideoFormat& format() const override { return source_->format(); }
  Result<std::optional<TimedPicture>> next() override;
  [[nodiscard]] std::optional<std::int64_t> frame_count_estimate() const override {
    return source_->frame_count_estimate();
  }
  [[nodiscard]] std::int64_t damaged_packets() const override { return source_->damaged_packets(); }

 private:
  std::unique_ptr<VideoSource> source_;
  const StopSignal& stop_;
  bool ended_ = false;
};

}  // namespace fbs::cli
