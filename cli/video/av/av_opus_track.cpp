#include "cli/video/av/av_opus_track.h"

extern "C" {
#include <libavutil/channel_layout.h>
#include <libavutil/mem.h>
}

#include <algorithm>
#include <limits>

#include "bitstream/sound_time.h"
#include "cli/video/opus_head.h"

namespace fbs {
namespace {

constexpr AVRational kSoundTick{1, kSoundClock};

bool describe(const SoundSetup& setup, AVCodecParameters& parameters) {
  const OpusHead head = opus_head(setup.channels, setup.skip);
  parameters.codec_type = AVMEDIA_TYPE_AUDIO;
  parameters.codec_id = AV_CODEC_ID_OPUS;
  parameters.sample_rate = kSoundClock;
  parameters.frame_size = setup.duration;
  parameters.initial_padding = setup.skip;
  parameters.seek_preroll = kSoundPreroll;
  av_channel_layout_default(&parameters.ch_layout, setup.channels);
  parameters.extradata = static_cast<std::uint8_t*>(
      av_mallocz(head.size() + static_cast<std::size_t>(AV_INPUT_BUFFER_PADDING_SIZE)));
  if (parameters.extradata == nullptr) return false;
  parameters.extradata_size = static_cast<int>(head.size());
  std::ranges::copy(head, parameters.extradata);
  return true;
}

}  // namespace

Result<AvOpusTrack> AvOpusTrack::add(const SoundSetup& setup, AvMuxer& muxer) {
  if (setup.codec != SoundCodec::kOpus) {
    return fail(ErrorCode::kUnsupported, "cannot write " + muxer.name() + ": its sound must be Opus");
  }
  if (setup.skip < 0 || setup.skip > std::numeric_limits<std::uint16_t>::max()) {
    return fail(ErrorCode::kUnsupported, "cannot write " + muxer.name() + ": its sound begins " +
                                             std::to_string(setup.skip) +
                                             "/48000 s early; 0 to 65535 are possible");
  }
  AvOpusTrack track;
  track.packet_.reset(av_packet_alloc());
  track.stream_ = muxer.add_stream();
  track.duration_ = setup.duration;
  if (!track.packet_ || track.stream_ == nullptr || !describe(setup, *track.stream_->codecpar)) {
    return muxer.error("out of memory");
  }
  track.delay_ = muxer.forgotten_delay(*track.stream_->codecpar);
  track.stream_->time_base = kSoundTick;
  return track;
}

Result<void> AvOpusTrack::write(std::span<const std::uint8_t> frame, std::int64_t begin, AvMuxer& muxer) {
  if (frame.empty()) return {};
  av_packet_unref(packet_.get());
  if (av_new_packet(packet_.get(), static_cast<int>(frame.size())) < 0) return muxer.error("out of memory");
  std::ranges::copy(frame, packet_->data);
  packet_->stream_index = stream_->index;
  packet_->pts = begin + delay_;
  packet_->dts = packet_->pts;
  packet_->duration = duration_;
  packet_->flags |= AV_PKT_FLAG_KEY;
  av_packet_rescale_ts(packet_.get(), kSoundTick, stream_->time_base);
  return muxer.write(*packet_);
}

}  // namespace fbs
