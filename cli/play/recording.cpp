#include "cli/play/recording.h"

#include "cli/output_check.h"
#include "cli/video/constant_rate.h"
#include "cli/video/y4m.h"

namespace fbs::cli {

Result<Recording> Recording::open(const std::string& name, const VideoFormat& format) {
  auto sink = open_video_sink(name, format);
  if (!sink) return fail(sink.error());
  if ((*sink)->replaced_leftover()) print_replaced_leftover(name);
  if (is_y4m_output(name) && plausible_rate(format.frame_rate))
    *sink = std::make_unique<ConstantRateSink>(std::move(*sink), format.frame_rate, true);
  return Recording(std::move(*sink), format.frame_rate);
}

Result<void> Recording::write(const Picture& picture, std::uint32_t duration) {
  if (auto written = sink_->write(picture, time_.pts()); !written) return written;
  time_.advance(duration);
  return {};
}

}  // namespace fbs::cli
