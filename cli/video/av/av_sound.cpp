#include "cli/video/av/av_sound.h"

#include <algorithm>

#include "bitstream/sound_syntax.h"
#include "cli/video/av/av_source.h"

namespace fbs {
namespace {

/// Longest priming that encoders put before the sound, 1/AV_TIME_BASE s; AAC has 46 ms.
constexpr std::int64_t kLongestPriming = 60'000;

}  // namespace

Result<AvSound> AvSound::open(const std::string& source, std::int64_t begin, AvMuxer& muxer) {
  AvSound sound;
  sound.name_ = source;
  int code = 0;
  sound.container_ = open_av_input(source, nullptr, code);
  if (!sound.container_) return fail(ErrorCode::kIo, "cannot read " + source + ": " + av_reason(code));
  const int index = av_find_best_stream(sound.container_.get(), AVMEDIA_TYPE_AUDIO, -1, -1, nullptr, 0);
  if (index < 0) return fail(ErrorCode::kUnsupported, source + ": contains no sound");
  discard_others(*sound.container_, index);
  sound.from_ = sound.container_->streams[index];
  sound.packet_.reset(av_packet_alloc());
  const std::int64_t start =
      sound.container_->start_time != AV_NOPTS_VALUE ? sound.container_->start_time : 0;
  const std::int64_t origin = first_picture_time(*sound.container_, source, nullptr).value_or(start);
  sound.begins_later_ = begin > 0 || origin - start > kLongestPriming;
  const AVRational base = sound.from_->time_base;
  sound.shift_ = av_rescale_q(begin, kTick, base) + av_rescale_q(origin, kTimeBase, base);

  const AVCodecID codec = sound.from_->codecpar->codec_id;
  if (avformat_query_codec(&muxer.container(), codec, FF_COMPLIANCE_NORMAL) == 0) {
    return fail(ErrorCode::kUnsupported, source + ": sound in " + avcodec_get_name(codec) +
                                             " does not fit in " + muxer.container().name +
                                             "; .mkv takes more");
  }
  sound.to_ = muxer.add_stream();
  if (sound.to_ == nullptr || !sound.packet_ ||
      avcodec_parameters_copy(sound.to_->codecpar, sound.from_->codecpar) < 0) {
    return muxer.error("out of memory");
  }
  sound.shift_ -= av_rescale_q(muxer.forgotten_delay(*sound.to_->codecpar), AVRational{1, kSoundClock}, base);
  sound.to_->codecpar->codec_tag = 0;  // each container has its own
  sound.to_->time_base = sound.from_->time_base;
  return sound;
}

Result<void> AvSound::copy_until(std::int64_t end, AvMuxer& muxer) {
  while (!ended_) {
    if (!waiting_) {
      auto found = read();
      if (!found) return fail(found.error());
      if (!*found) break;
    }
    waiting_ = packet_->dts != AV_NOPTS_VALUE && av_rescale_q(packet_->dts, from_->time_base, kTick) >= end;
    if (waiting_) break;
    packet_->stream_index = to_->index;
    av_packet_rescale_ts(packet_.get(), from_->time_base, to_->time_base);
    if (auto written = muxer.write(*packet_); !written) return written;
  }
  return {};
}

Result<bool> AvSound::read() {
  int code = 0;
  do {
    av_packet_unref(packet_.get());
    code = av_read_frame(container_.get(), packet_.get());
    if (packet_->pts != AV_NOPTS_VALUE) packet_->pts -= shift_;
    if (packet_->dts != AV_NOPTS_VALUE) packet_->dts -= shift_;
  } while (code >= 0 && (packet_->stream_index != from_->index || (begins_later_ && packet_->pts < 0)));
  ended_ = code == AVERROR_EOF;
  if (ended_) return false;
  if (code < 0) return fail(ErrorCode::kIo, "cannot read " + name_ + ": " + av_reason(code));
  packet_->pos = -1;
  return true;
}

}  // namespace fbs
