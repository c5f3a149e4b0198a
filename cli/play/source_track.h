// The source of a stream, shown beside it.
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "cli/video/video_source.h"

namespace fbs::cli {

/// Pictures of a video by time. Going back reopens it.
class SourceTrack {
 public:
  /// @param name  anything that open_video_source() opens twice: no camera, no standard input
  static Result<SourceTrack> open(const std::string& name);

  /// The picture shown at `time`, in BGR: the last that begins until then, with half a picture's tolerance.
  /// @param time  1/90000 s from the start of the source
  Result<cv::Mat> picture_at(std::uint64_t time);

 private:
  SourceTrack(std::string name, std::unique_ptr<VideoSource> source)
      : name_(std::move(name)), source_(std::move(source)) {}
  Result<void> go_to(std::int64_t time);

  std::string name_;
  std::unique_ptr<VideoSource> source_;
  std::optional<TimedPicture> shown_, next_;
  bool ended_ = false;
};

}  // namespace fbs::cli
