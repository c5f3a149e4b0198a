#include "cli/play/sound/recorded_sound.h"

#include <algorithm>
#include <utility>

#include "bitstream/sound_time.h"
#include "common/picture.h"

namespace fbs::cli {
namespace {

constexpr int kChannelBitrate = 24000;  // bit/s: enough to lose nothing of the stream's few

}  // namespace

Result<RecordedSound> RecordedSound::create(const SoundParts& parts, int sample_rate, int channels) {
  SoundSettings settings;
  settings.sample_rate = sample_rate;
  settings.channels = channels;
  settings.bitrate = kChannelBitrate * channels;
  auto encoder = SoundEncoder::create(settings);
  if (!encoder) return fail(encoder.error());
  return RecordedSound(std::move(*encoder), SoundCursor(parts, sample_rate, channels));
}

Result<void> RecordedSound::write(const SoundSpan& span, std::int64_t end, VideoSink& sink) {
  if (!span.heard() || span.begin != next_) {
    waiting_.assign(room(end_), 0);
    cursor_.seek(span.begin);
  }
  next_ = span.heard() ? span.end : -1;
  end_ = end;
  if (span.heard()) {
    const std::vector<std::int16_t> heard = cursor_.take(span.end);
    waiting_.insert(waiting_.end(), heard.begin(), heard.end());
  } else {
    waiting_.resize(room(end));
  }

  const std::size_t count = std::min(room(end), waiting_.size());
  SoundEncoder::Frames frames;
  if (auto coded = encoder_->add(std::span(waiting_).first(count), frames); !coded) return coded;
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(count));
  written_ += static_cast<std::int64_t>(count) / cursor_.channels();
  return write(frames, sink);
}

std::size_t RecordedSound::room(std::int64_t end) const {
  const std::int64_t samples = end * encoder_->sample_rate() / kTicksPerSecond - written_;
  return static_cast<std::size_t>(std::max<std::int64_t>(samples, 0) * cursor_.channels());
}

Result<void> RecordedSound::write(const SoundEncoder::Frames& frames, VideoSink& sink) {
  for (const auto& frame : frames) {
    const std::int64_t time = frame_time(setup(), frames_++);
    if (auto written = sink.write_sound(frame, time); !written) return written;
  }
  return {};
}

Result<void> RecordedSound::finish(VideoSink& sink) {
  SoundEncoder::Frames frames;
  if (auto coded = encoder_->finish(frames); !coded) return coded;
  return write(frames, sink);
}

}  // namespace fbs::cli
