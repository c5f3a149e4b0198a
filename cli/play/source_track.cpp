#include "cli/play/source_track.h"

#include <utility>

#include "bitstream/syntax.h"
#include "cli/video/colour.h"
#include "cli/video/open/open_video.h"

namespace fbs::cli {

Result<SourceTrack> SourceTrack::open(const std::string& name) {
  if (name == "-" || name.starts_with("camera:"))
    return fail(ErrorCode::kUnsupported, "--source: " + name + " cannot be read again after a step back");
  auto source = open_video_source(name);
  if (!source) return fail(source.error());
  return SourceTrack(name, std::move(*source));
}

Result<cv::Mat> SourceTrack::picture_at(std::uint64_t time) {
  const auto wanted = static_cast<std::int64_t>(time + nominal_duration(source_->format().frame_rate) / 2);
  if (shown_ && shown_->pts > wanted) {
    auto again = open_video_source(name_);
    if (!again) return fail(again.error());
    source_ = std::move(*again);
    shown_.reset();
    next_.reset();
    ended_ = false;
  }
  if (auto gone = go_to(wanted); !gone) return fail(gone.error());
  if (!shown_) return fail(ErrorCode::kIo, name_ + ": contains no pictures");
  const VideoFormat& format = source_->format();
  RgbImage rgb = rgb_from_picture(shown_->picture, format.range, format.matrix, ChannelOrder::kBgr);
  return cv::Mat(rgb.height, rgb.width, CV_8UC3, rgb.samples.data()).clone();
}

Result<void> SourceTrack::go_to(std::int64_t time) {
  while (!ended_) {
    if (!next_) {
      auto read = source_->next();
      // A truncated source ends there: the stream continues.
      if (!read && !shown_) return fail(read.error());
      ended_ = !read || !*read;
      if (ended_) return {};
      next_ = std::move(**read);
    }
    if (shown_ && next_->pts > time) return {};
    shown_ = std::move(next_);
    next_.reset();
  }
  return {};
}

}  // namespace fbs::cli
