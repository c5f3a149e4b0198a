#include "cli/video/av/av_sound_source.h"

#include <algorithm>
#include <utility>

#include "cli/video/av/av_sound_timeline.h"
#include "cli/video/av/av_source.h"
#include "cli/video/av/av_support.h"

namespace fbs {
namespace {

class AvSoundSource final : public SoundSource {
 public:
  AvSoundSource(std::string name, const SoundSourceOptions& options);

  /// @return false when there is no sound
  Result<bool> open(const SoundSourceOptions& options);
  Result<std::optional<std::vector<std::int16_t>>> next() override;
  [[nodiscard]] std::int64_t damaged_packets() const override { return damaged_packets_; }

 private:
  /// @return index of the stream; nullopt when there is no sound
  Result<std::optional<int>> choose_track(std::optional<int> track) const;
  Result<void> open_decoder(int index);
  /// Decodes the next frame into frame_. @return false at the end
  Result<bool> decode();
  /// Sends the next packet, or the end, to the decoder.
  Result<void> feed();
  /// Appends frame_, or some of the silence before it.
  Result<void> place(std::vector<std::int16_t>& samples);
  void cut(std::vector<std::int16_t>& samples);
  void skip_damage();
  [[nodiscard]] std::optional<std::int64_t> begin_of_frame() const;
  [[nodiscard]] tl::unexpected<Error> error(ErrorCode code, const std::string& text) const {
    return fail(code, name_ + ": " + text);
  }

  std::string name_;
  AvInput container_;
  AvCodec decoder_;
  AvPacket packet_{av_packet_alloc()};
  AvFrame frame_{av_frame_alloc()};
  AVStream* stream_ = nullptr;  ///< of container_
  AvSoundTimeline timeline_;
  std::int64_t start_ = 0;  ///< of the first picture, on the container's clock, 1/AV_TIME_BASE s
  std::int64_t left_;       ///< samples of one channel that may still be returned
  int channels_;
  bool frame_waiting_ = false;  ///< frame_ is decoded and not yet placed
  bool drained_ = false;        ///< the decoder has got its end-of-stream packet
  bool ended_ = false;
  std::int64_t damaged_packets_ = 0;
};

AvSoundSource::AvSoundSource(std::string name, const SoundSourceOptions& options)
    : name_(std::move(name)),
      timeline_(options.sample_rate, options.channels),
      left_(av_rescale(std::max<std::int64_t>(options.end, 0), options.sample_rate, kTicksPerSecond)),
      channels_(options.channels) {
  if (left_ < 0) left_ = std::numeric_limits<std::int64_t>::max();  // beyond what the clock counts
}

Result<bool> AvSoundSource::open(const SoundSourceOptions& options) {
  int code = 0;
  container_ = open_av_input(name_, options.stop, code);
  if (!container_) return fail(ErrorCode::kIo, "cannot read " + name_ + ": " + av_reason(code));
  const auto index = choose_track(options.track);
  if (!index) return fail(index.error());
  if (!*index) return false;
  discard_others(*container_, **index);
  if (auto opened = open_decoder(**index); !opened) return fail(opened.error());
  const auto start = first_picture_time(*container_, name_, options.stop);
  if (!start) return fail(start.error());
  start_ = *start;
  return true;
}

Result<std::optional<int>> AvSoundSource::choose_track(std::optional<int> track) const {
  std::vector<int> tracks;
  for (unsigned i = 0; i < container_->nb_streams; ++i) {
    const bool is_sound = container_->streams[i]->codecpar->codec_type == AVMEDIA_TYPE_AUDIO;
    if (is_sound) tracks.push_back(static_cast<int>(i));
  }
  if (track && (*track < 0 || *track >= std::ssize(tracks))) {
    return fail(missing_track(name_, *track, std::ssize(tracks)));
  }
  if (tracks.empty()) return std::nullopt;
  if (track) return tracks[static_cast<std::size_t>(*track)];
  const int video = av_find_best_stream(container_.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  const AVCodec* decoder = nullptr;  // passed so that tracks without a decoder come last
  const int best = av_find_best_stream(container_.get(), AVMEDIA_TYPE_AUDIO, -1, video, &decoder, 0);
  return best >= 0 ? best : tracks.front();
}

Result<void> AvSoundSource::open_decoder(int index) {
  stream_ = container_->streams[index];
  const AVCodecID id = stream_->codecpar->codec_id;
  const AVCodec* codec = avcodec_find_decoder(id);
  if (codec == nullptr) {
    return error(ErrorCode::kUnsupported,
                 std::string("no decoder for its sound (") + avcodec_get_name(id) + ")");
  }
  const int code = open_av_decoder(*codec, *stream_, 1, decoder_);
  if (!decoder_) return error(ErrorCode::kInternal, "out of memory");
  if (code < 0) return error(ErrorCode::kUnsupported, "cannot decode its sound: " + av_reason(code));
  return {};
}

Result<std::optional<std::vector<std::int16_t>>> AvSoundSource::next() {
  std::vector<std::int16_t> samples;
  while (samples.empty()) {
    if (ended_ || left_ <= 0) return std::nullopt;
    if (!frame_waiting_) {
      const auto decoded = decode();
      if (!decoded) return fail(decoded.error());
      frame_waiting_ = *decoded;
      ended_ = !*decoded;
    }
    if (ended_) {
      timeline_.drain(samples);
    } else if (auto placed = place(samples); !placed) {
      return error(placed.error().code, placed.error().text);
    }
    cut(samples);
  }
  return samples;
}

Result<bool> AvSoundSource::decode() {
  for (;;) {
    const int code = avcodec_receive_frame(decoder_.get(), frame_.get());
    if (code == AVERROR_EOF) return false;
    const bool usable =
        code >= 0 && frame_->nb_samples > 0 && frame_->sample_rate > 0 && frame_->ch_layout.nb_channels > 0;
    if (usable) return true;
    if (code == AVERROR(EAGAIN)) {
      if (auto fed = feed(); !fed) return fail(fed.error());
    } else if (code < 0) {
      skip_damage();
    }
  }
}

Result<void> AvSoundSource::feed() {
  if (drained_) return error(ErrorCode::kInternal, "decoder of sound does not end");
  int code = 0;
  do {
    av_packet_unref(packet_.get());
    code = av_read_frame(container_.get(), packet_.get());
  } while (code >= 0 && packet_->stream_index != stream_->index);
  if (code < 0) {
    if (code != AVERROR_EOF && code != AVERROR_INVALIDDATA) return error(ErrorCode::kIo, av_reason(code));
    drained_ = true;
    avcodec_send_packet(decoder_.get(), nullptr);
    return {};
  }
  if (avcodec_send_packet(decoder_.get(), packet_.get()) < 0) skip_damage();
  return {};
}

void AvSoundSource::skip_damage() {
  ++damaged_packets_;
  timeline_.expect_gap();
}

Result<void> AvSoundSource::place(std::vector<std::int16_t>& samples) {
  if (auto prepared = timeline_.prepare(*frame_, samples); !prepared) return prepared;
  const std::optional<std::int64_t> begin = begin_of_frame();
  const std::int64_t gap = begin ? timeline_.gap(*frame_, *begin) : 0;
  if (gap > 0) {
    const std::int64_t second = frame_->sample_rate;
    timeline_.add_silence(*frame_, static_cast<int>(std::min(gap, second)), samples);
    if (gap > second) return {};
  }
  if (gap < 0) timeline_.expect_gap();  // until a frame that is not left out altogether
  if (gap == 0 && begin) {
    if (auto followed = timeline_.follow(*frame_, *begin, samples); !followed) return followed;
  }
  const auto skipped =
      static_cast<int>(std::min<std::int64_t>(std::max<std::int64_t>(-gap, 0), frame_->nb_samples));
  timeline_.add(*frame_, skipped, samples);
  frame_waiting_ = false;
  return {};
}

void AvSoundSource::cut(std::vector<std::int16_t>& samples) {
  const auto count = static_cast<std::int64_t>(samples.size()) / channels_;
  const std::int64_t kept = std::min(count, left_);
  samples.resize(static_cast<std::size_t>(kept * channels_));
  left_ -= kept;
}

std::optional<std::int64_t> AvSoundSource::begin_of_frame() const {
  if (frame_->best_effort_timestamp == AV_NOPTS_VALUE) return std::nullopt;
  return av_rescale_q(frame_->best_effort_timestamp, stream_->time_base, kTimeBase) - start_;
}

}  // namespace

Result<std::unique_ptr<SoundSource>> open_av_sound_source(const std::string& input,
                                                          const SoundSourceOptions& options) {
  auto source = std::make_unique<AvSoundSource>(input, options);
  const auto opened = source->open(options);
  if (!opened) return fail(opened.error());
  if (!*opened) return nullptr;
  return source;
}

}  // namespace fbs
