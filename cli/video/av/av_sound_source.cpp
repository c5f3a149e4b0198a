#include "cli/video/av/av_sound_source.h"

#include <algorithm>
#include <utility>

#include "cli/video/av/av_sound_timeline.h"
#include "cli/video/av/av_source.h"
#include "cli/video/av/av_track.h"

namespace fbs {
namespace {

class AvSoundSource final : public SoundSource {
 public:
  AvSoundSource(std::string name, const SoundSourceOptions& options);

  /// @return false when there is no sound
  Result<bool> open(const SoundSourceOptions& options);
  Result<std::optional<std::vector<std::int16_t>>> next() override;
  [[nodiscard]] std::int64_t damaged_packets() const override { return track_.damaged_packets(); }

 private:
  /// @return index of the stream; nullopt when there is no sound
  Result<std::optional<int>> choose_track(std::optional<int> track) const;
  Result<void> open_decoder(int index);
  /// Decodes the next frame with samples. @return false at the end, also of a container that is cut off
  Result<bool> decode();
  /// Appends the track's frame, or some of the silence before it.
  Result<void> place(std::vector<std::int16_t>& samples);
  void cut(std::vector<std::int16_t>& samples);

  AvTrack track_;
  AvSoundTimeline timeline_;
  std::int64_t start_ = 0;  ///< of the first picture, on the container's clock, 1/AV_TIME_BASE s
  std::int64_t left_;       ///< samples of one channel that may still be returned
  int channels_;
  bool frame_waiting_ = false;  ///< the track's frame has not been placed
  bool ended_ = false;
};

AvSoundSource::AvSoundSource(std::string name, const SoundSourceOptions& options)
    : track_(std::move(name)),
      timeline_(options.sample_rate, options.channels),
      left_(av_rescale(std::max<std::int64_t>(options.end, 0), options.sample_rate, kTicksPerSecond)),
      channels_(options.channels) {
  if (left_ < 0) left_ = std::numeric_limits<std::int64_t>::max();  // beyond what the clock counts
}

Result<bool> AvSoundSource::open(const SoundSourceOptions& options) {
  if (const int code = track_.open(options.stop); code < 0)
    return fail(ErrorCode::kIo, "cannot read " + track_.name() + ": " + av_reason(code));
  const auto index = choose_track(options.track);
  if (!index) return fail(index.error());
  if (!*index) return false;
  if (auto opened = open_decoder(**index); !opened) return fail(opened.error());
  const auto start = first_picture_time(track_.container(), track_.name(), options.stop);
  if (!start) return fail(start.error());
  start_ = *start;
  return true;
}

Result<std::optional<int>> AvSoundSource::choose_track(std::optional<int> track) const {
  std::vector<int> tracks;
  for (unsigned i = 0; i < track_.container().nb_streams; ++i) {
    const bool is_sound = track_.container().streams[i]->codecpar->codec_type == AVMEDIA_TYPE_AUDIO;
    if (is_sound) tracks.push_back(static_cast<int>(i));
  }
  if (track && (*track < 0 || *track >= std::ssize(tracks))) {
    return fail(missing_track(track_.name(), *track, std::ssize(tracks)));
  }
  if (tracks.empty()) return std::nullopt;
  if (track) return tracks[static_cast<std::size_t>(*track)];
  const int video = av_find_best_stream(&track_.container(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  const AVCodec* decoder = nullptr;  // passed so that tracks without a decoder come last
  const int best = av_find_best_stream(&track_.container(), AVMEDIA_TYPE_AUDIO, -1, video, &decoder, 0);
  return best >= 0 ? best : tracks.front();
}

Result<void> AvSoundSource::open_decoder(int index) {
  const AVCodecID id = track_.container().streams[index]->codecpar->codec_id;
  const AVCodec* codec = avcodec_find_decoder(id);
  if (codec != nullptr) return track_.choose(index, *codec, 1, "sound");
  return track_.error(ErrorCode::kUnsupported,
                      std::string("no decoder for its sound (") + avcodec_get_name(id) + ")");
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
      return track_.error(placed.error().code, placed.error().text);
    }
    cut(samples);
  }
  return samples;
}

Result<bool> AvSoundSource::decode() {
  const std::int64_t damaged = track_.damaged_packets();
  const AVFrame& frame = track_.frame();
  for (;;) {
    auto decoded = track_.decode();
    if (track_.damaged_packets() > damaged) timeline_.expect_gap();
    if (!decoded && decoded.error().code == ErrorCode::kTruncated) return false;
    if (!decoded || !*decoded) return decoded;
    if (frame.nb_samples > 0 && frame.sample_rate > 0 && frame.ch_layout.nb_channels > 0) return true;
  }
}

Result<void> AvSoundSource::place(std::vector<std::int16_t>& samples) {
  const AVFrame& frame = track_.frame();
  if (auto prepared = timeline_.prepare(frame, samples); !prepared) return prepared;
  std::optional<std::int64_t> begin = track_.frame_time(kTimeBase);
  if (begin) *begin -= start_;
  const std::int64_t gap = begin ? timeline_.gap(frame, *begin) : 0;
  if (gap > 0) {
    const std::int64_t second = frame.sample_rate;
    timeline_.add_silence(frame, static_cast<int>(std::min(gap, second)), samples);
    if (gap > second) return {};
  }
  if (gap < 0) timeline_.expect_gap();  // until a frame that is not left out altogether
  if (gap == 0 && begin) {
    if (auto followed = timeline_.follow(frame, *begin, samples); !followed) return followed;
  }
  const auto skipped =
      static_cast<int>(std::min<std::int64_t>(std::max<std::int64_t>(-gap, 0), frame.nb_samples));
  timeline_.add(frame, skipped, samples);
  frame_waiting_ = false;
  return {};
}

void AvSoundSource::cut(std::vector<std::int16_t>& samples) {
  const auto count = static_cast<std::int64_t>(samples.size()) / channels_;
  const std::int64_t kept = std::min(count, left_);
  samples.resize(static_cast<std::size_t>(kept * channels_));
  left_ -= kept;
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
