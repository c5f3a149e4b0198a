#include "cli/play/recording.h"

#include "cli/files/output_check.h"
#include "cli/video/constant_rate.h"
#include "cli/video/open/open_video.h"
#include "cli/video/y4m/y4m.h"

namespace fbs::cli {

Result<Recording> Recording::open(const std::string& name, const VideoFormat& format,
                                  std::optional<RecordedSound> sound) {
  SinkOptions options;
  if (sound) options.sound = sound->setup();
  auto sink = open_video_sink(name, format, options);
  if (!sink) return fail(sink.error());
  if ((*sink)->replaced_leftover()) print_replaced_leftover(name);
  if (is_y4m_output(name) && plausible_rate(format.frame_rate))
    *sink = std::make_unique<ConstantRateSink>(std::move(*sink), format.frame_rate, true);
  return Recording(std::move(*sink), format.frame_rate, std::move(sound));
}

Result<void> Recording::write(const Picture& picture, std::uint32_t duration, const SoundSpan& sound) {
  if (auto written = sink_->write(picture, time_.pts()); !written) return written;
  time_.advance(duration);
  return sound_ ? sound_->write(sound, time_.pts(), *sink_) : Result<void>();
}

Result<void> Recording::finish() {
  if (sound_)
    if (auto finished = sound_->finish(*sink_); !finished) return finished;
  return sink_->finish();
}

}  // namespace fbs::cli
