// A video of what the player has shown.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "cli/decode/decoded_time.h"
#include "cli/video/video_sink.h"

namespace fbs::cli {

/// Writes pictures one after another as long as each lasts in the stream, however long it was looked at.
class Recording {
 public:
  static Result<Recording> open(const std::string& name, const VideoFormat& format);

  /// @param duration  1/90000 s
  Result<void> write(const Picture& picture, std::uint32_t duration);
  /// Gives the file its name. Call it once, last.
  Result<void> finish() { return sink_->finish(); }

 private:
  Recording(std::unique_ptr<VideoSink> sink, Rational rate) : sink_(std::move(sink)), time_(rate) {}

  std::unique_ptr<VideoSink> sink_;
  DecodedTime time_;
};

}  // namespace fbs::cli
