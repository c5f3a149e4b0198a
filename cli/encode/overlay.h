// A video of the source with mesh and snakes drawn over it, for visual inspection.
#pragma once

#include <memory>
#include <string>

#include "cli/video/video_sink.h"
#include "encoder/encoder.h"

namespace fbs::cli {

/// Writes the source, enlarged when small, with the projected mesh (thin), the snakes (thick) and the
/// tracker's confidence. In Y4M, which has no timestamps, pictures are repeated or dropped to keep the speed.
class Overlay {
 public:
  static Result<Overlay> create(const std::string& name, const VideoFormat& format);
  Result<void> write(const Picture& picture, std::int64_t pts, const PictureAnalysis& analysis);
  Result<void> finish() { return sink_->finish(); }

 private:
  Overlay(std::unique_ptr<VideoSink> sink, VideoFormat format, int zoom)
      : sink_(std::move(sink)), format_(format), zoom_(zoom) {}

  std::unique_ptr<VideoSink> sink_;
  VideoFormat format_;
  int zoom_;
};

}  // namespace fbs::cli
