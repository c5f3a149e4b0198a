#include "cli/video/av/av_opus_track.h"

extern "C" {
#include <libavutil/channel_layout.h>
#include <libavutil/mem.h>
}

#include <algorithm>
#include <array>
#include <limits>

namespace fbs {
namespace {

constexpr AVRational kSoundTick{1, kSoundClock};
constexpr int kSeekPreroll = 80 * kSoundClock / 1000;  // RFC 7845 4.6

using OpusHead = std::array<std::uint8_t, 19>;

/// RFC 7845 5.1, with mapping family 0.
OpusHead opus_head(const SoundSetup& setup) {
  const auto byte = [](std::int32_t value, std::size_t index) {
    return static_cast<std::uint8_t>(static_cast<std::uint32_t>(value) >> (8 * index));
  };
  OpusHead head{'O', 'p', 'u', 's', 'H', 'e', 'a', 'd', 1};
  head[9] = static_cast<std::uint8_t>(setup.channels);
  for (std::size_t i = 0; i < 2; ++i) head[10 + i] = byte(setup.skip, i);
  for (std::size_t i = 0; i < 4; ++i) head[12 + i] = byte(kSoundClock, i);
  return head;
}

bool describe(const SoundSetup& setup, AVCodecParameters& parameters) {
  const OpusHead head = opus_head(setup);
  parameters.codec_type = AVMEDIA_TYPE_AUDIO;
  parameters.codec_id = AV_CODEC_ID_OPUS;
  parameters.sample_rate = kSoundClock;
  parameters.frame_size = setup.duration;
  parameters.initial_padding = setup.skip;
  parameters.seek_preroll = kSeekPreroll;
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
