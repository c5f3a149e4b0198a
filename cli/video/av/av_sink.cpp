#include "cli/video/av/av_sink.h"

extern "C" {
#include <libavutil/opt.h>
}

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>

#include "cli/video/av/av_muxer.h"
#include "cli/video/av/av_opus_track.h"
#include "cli/video/av/av_sound.h"
#include "cli/video/av/av_support.h"
#include "cli/video/timestamps.h"

namespace fbs {
namespace {

constexpr const char* kQualityCrf = "12";
constexpr const char* kPreset = "veryfast";
constexpr int kFallbackQuantiser = 2;  // MPEG-4 part 2, best of 1..31 in practice

/// A clock in which both a picture period and a 1/90000 s tick are (nearly) whole numbers.
AVRational fine_time_base(Rational rate) {
  const std::int64_t per_second = std::max<std::int64_t>(rate.num, 1);
  std::int64_t factor = (kTicksPerSecond + per_second - 1) / per_second;
  factor = std::min(factor, std::numeric_limits<int>::max() / per_second);
  return {1, static_cast<int>(per_second * std::max<std::int64_t>(factor, 1))};
}

void set_colour(AVCodecContext& encoder, const VideoFormat& format) {
  encoder.color_range = format.range == ColourRange::kFull ? AVCOL_RANGE_JPEG : AVCOL_RANGE_MPEG;
  if (format.matrix == ColourMatrix::kBt709) {
    encoder.colorspace = AVCOL_SPC_BT709;
    encoder.color_primaries = AVCOL_PRI_BT709;
    encoder.color_trc = AVCOL_TRC_BT709;
  } else if (format.matrix == ColourMatrix::kBt601) {
    encoder.colorspace = AVCOL_SPC_SMPTE170M;
    encoder.color_primaries = AVCOL_PRI_SMPTE170M;
    encoder.color_trc = AVCOL_TRC_SMPTE170M;
  }
}

void fill_plane(const Plane& plane, AVFrame& frame, int index) {
  for (int y = 0; y < plane.height; ++y) {
    std::copy_n(plane.row(y), plane.width,
                frame.data[index] + static_cast<std::ptrdiff_t>(y) * frame.linesize[index]);
  }
}

/// 4:2:0 chroma at luma size, each sample repeated: averaging restores it exactly.
void spread_plane(const Plane& plane, AVFrame& frame, int index) {
  for (int y = 0; y < frame.height; ++y) {
    const std::uint8_t* from = plane.row(y / 2);
    std::uint8_t* to = frame.data[index] + static_cast<std::ptrdiff_t>(y) * frame.linesize[index];
    for (int x = 0; x < frame.width; ++x) to[x] = from[x / 2];
  }
}

class AvSink final : public VideoSink {
 public:
  explicit AvSink(const VideoFormat& format) : format_(format) {}

  Result<void> open(const std::string& output, const SinkOptions& options);
  Result<void> write(const Picture& picture, std::int64_t pts) override;
  Result<void> write_sound(std::span<const std::uint8_t> frame, std::int64_t begin) override;
  [[nodiscard]] bool replaced_leftover() const override { return muxer_->replaced_leftover(); }
  Result<void> finish() override;

 private:
  Result<void> open_encoder();
  /// Sends a frame, or the end, to the encoder and writes the packets it returns.
  Result<void> encode(const AVFrame* frame);
  [[nodiscard]] std::int64_t encoder_pts(std::int64_t pts) const;

  VideoFormat format_;
  std::unique_ptr<AvMuxer> muxer_;
  AvCodec encoder_;
  std::optional<AvSound> sound_;     ///< copied from a file
  std::optional<AvOpusTrack> opus_;  ///< given to write_sound
  AvFrame frame_{av_frame_alloc()};
  AvPacket packet_{av_packet_alloc()};
  AVStream* stream_ = nullptr;  ///< of muxer_
  std::int64_t period_ = 1;     ///< of a picture at the regular rate, encoder's time base
  std::int64_t last_pts_ = std::numeric_limits<std::int64_t>::min();  ///< encoder's time base
};

Result<void> AvSink::open(const std::string& output, const SinkOptions& options) {
  auto muxer = AvMuxer::create(output, av_match_ext(output.c_str(), "mp4") != 0 ? "mp4" : "matroska");
  if (!muxer) return fail(muxer.error());
  muxer_ = std::move(*muxer);
  stream_ = muxer_->add_stream();
  if (stream_ == nullptr) return muxer_->error("out of memory");
  if (auto opened = open_encoder(); !opened) return opened;
  stream_->time_base = encoder_->time_base;
  stream_->avg_frame_rate = encoder_->framerate;
  stream_->sample_aspect_ratio = encoder_->sample_aspect_ratio;
  if (avcodec_parameters_from_context(stream_->codecpar, encoder_.get()) < 0) {
    return muxer_->error("out of memory");
  }
  if (!options.sound_source.empty()) {
    auto sound = AvSound::open(options.sound_source, options.sound_begin, *muxer_);
    if (!sound) return fail(sound.error());
    sound_ = std::move(*sound);
  }
  if (options.sound) {
    auto track = AvOpusTrack::add(*options.sound, *muxer_);
    if (!track) return fail(track.error());
    opus_ = std::move(*track);
  }
  return muxer_->write_header();
}

Result<void> AvSink::open_encoder() {
  const AVCodec* codec = avcodec_find_encoder_by_name("libx264");
  const bool have_x264 = codec != nullptr;
  if (!have_x264) codec = avcodec_find_encoder(AV_CODEC_ID_MPEG4);
  if (codec == nullptr) return muxer_->error("this libav has no H.264 encoder");
  encoder_.reset(avcodec_alloc_context3(codec));
  if (!encoder_) return muxer_->error("out of memory");

  const bool odd = format_.width % 2 != 0 || format_.height % 2 != 0;
  encoder_->width = format_.width;
  encoder_->height = format_.height;
  encoder_->pix_fmt = odd && have_x264 ? AV_PIX_FMT_YUV444P : AV_PIX_FMT_YUV420P;
  encoder_->time_base = fine_time_base(format_.frame_rate);
  encoder_->framerate = {static_cast<int>(format_.frame_rate.num), static_cast<int>(format_.frame_rate.den)};
  period_ = std::max<std::int64_t>(encoder_->time_base.den / std::max(encoder_->framerate.num, 1), 1) *
            encoder_->framerate.den;
  encoder_->sample_aspect_ratio = {static_cast<int>(format_.pixel_aspect.num),
                                   static_cast<int>(format_.pixel_aspect.den)};
  set_colour(*encoder_, format_);
  if ((muxer_->container().flags & AVFMT_GLOBALHEADER) != 0) encoder_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;

  AVDictionary* settings = nullptr;
  if (have_x264) {
    av_dict_set(&settings, "preset", kPreset, 0);
    av_dict_set(&settings, "crf", kQualityCrf, 0);
  } else {
    encoder_->flags |= AV_CODEC_FLAG_QSCALE;
    encoder_->global_quality = kFallbackQuantiser * FF_QP2LAMBDA;
    // The clock of MPEG-4 part 2 has 16 bits.
    encoder_->time_base = {encoder_->framerate.den, encoder_->framerate.num};
    period_ = 1;
  }
  const int code = avcodec_open2(encoder_.get(), codec, &settings);
  av_dict_free(&settings);
  if (code < 0) return muxer_->error(std::string(codec->name) + ": " + av_reason(code));

  frame_->format = encoder_->pix_fmt;
  frame_->width = format_.width;
  frame_->height = format_.height;
  if (av_frame_get_buffer(frame_.get(), 0) < 0) return muxer_->error("out of memory");
  return {};
}

Result<void> AvSink::write(const Picture& picture, std::int64_t pts) {
  if (picture.width() != format_.width || picture.height() != format_.height) {
    return fail(ErrorCode::kInvalidArgument, "picture size differs from the video's");
  }
  if (av_frame_make_writable(frame_.get()) < 0) return muxer_->error("out of memory");
  fill_plane(picture.y, *frame_, 0);
  const auto copy_chroma = frame_->format == AV_PIX_FMT_YUV444P ? spread_plane : fill_plane;
  copy_chroma(picture.u, *frame_, 1);
  copy_chroma(picture.v, *frame_, 2);

  const std::int64_t earliest =
      last_pts_ == std::numeric_limits<std::int64_t>::min() ? last_pts_ : last_pts_ + 1;
  last_pts_ = std::max(encoder_pts(pts), earliest);
  frame_->pts = last_pts_;
  return encode(frame_.get());
}

Result<void> AvSink::write_sound(std::span<const std::uint8_t> frame, std::int64_t begin) {
  if (!opus_) return VideoSink::write_sound(frame, begin);
  return opus_->write(frame, begin, *muxer_);
}

/// Exact on the regular grid, where 90000 ticks a second may only round.
std::int64_t AvSink::encoder_pts(std::int64_t pts) const {
  const Rational rate = format_.frame_rate;
  const std::int64_t nearest =
      av_rescale(pts, rate.num, kTicksPerSecond * static_cast<std::int64_t>(rate.den));
  if (std::abs(regular_pts(nearest, rate) - pts) <= 1) return nearest * period_;
  return av_rescale_q(pts, kTick, encoder_->time_base);
}

Result<void> AvSink::finish() {
  if (auto encoded = encode(nullptr); !encoded) return encoded;
  if (sound_) {
    const std::int64_t end = av_rescale_q(last_pts_ + period_, encoder_->time_base, kTick);
    if (auto copied = sound_->copy_until(end, *muxer_); !copied) return copied;
  }
  return muxer_->finish();
}

Result<void> AvSink::encode(const AVFrame* frame) {
  int code = avcodec_send_frame(encoder_.get(), frame);
  while (code >= 0) {
    code = avcodec_receive_packet(encoder_.get(), packet_.get());
    if (code < 0) break;
    if (sound_) {
      const std::int64_t now = av_rescale_q(packet_->dts, encoder_->time_base, kTick);
      if (auto copied = sound_->copy_until(now, *muxer_); !copied) return copied;
    }
    packet_->stream_index = stream_->index;
    packet_->duration = period_;
    av_packet_rescale_ts(packet_.get(), encoder_->time_base, stream_->time_base);
    if (auto written = muxer_->write(*packet_); !written) return written;
  }
  if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return {};
  return muxer_->error(av_reason(code));
}

}  // namespace

Result<std::unique_ptr<VideoSink>> open_av_sink(const std::string& output, const VideoFormat& format,
                                                const SinkOptions& options) {
  auto sink = std::make_unique<AvSink>(format);
  if (auto opened = sink->open(output, options); !opened) return fail(opened.error());
  return sink;
}

}  // namespace fbs
