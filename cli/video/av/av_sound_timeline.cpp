#include "cli/video/av/av_sound_timeline.h"

extern "C" {
#include <libavutil/channel_layout.h>
#include <libavutil/opt.h>
#include <libavutil/samplefmt.h>
}

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace fbs {
namespace {

constexpr std::int64_t kTolerance = 20'000;         // 1/AV_TIME_BASE s
constexpr std::int64_t kExactTolerance = 200;       // containers round to 1 ms at worst, most do not
constexpr double kMeanWeight = 1.0 / 64;            // of a frame in the mean difference: about 1.5 s
constexpr double kDriftTolerance = 2'000;           // 1/AV_TIME_BASE s; more than the jitter of the mean
constexpr double kCorrectionShare = 0.25;           // of the mean difference, in each correction
constexpr double kGreatestStretch = 0.002;          // a thirtieth of a semitone
constexpr std::int64_t kCorrection = AV_TIME_BASE;  // duration of one

}  // namespace

AvSoundTimeline::Format AvSoundTimeline::format_of(const AVFrame& frame) {
  const AVChannelLayout& layout = frame.ch_layout;
  return {frame.format, frame.sample_rate, layout.nb_channels,
          layout.order == AV_CHANNEL_ORDER_NATIVE ? layout.u.mask : 0};
}

Result<void> AvSoundTimeline::prepare(const AVFrame& frame, std::vector<std::int16_t>& out) {
  const Format format = format_of(frame);
  if (resampler_ && format == format_) return {};
  drain(out);
  format_ = format;
  return open(frame);
}

Result<void> AvSoundTimeline::open(const AVFrame& frame) {
  AVChannelLayout from{};
  AVChannelLayout to{};
  av_channel_layout_default(&to, channels_);
  if (frame.ch_layout.order == AV_CHANNEL_ORDER_NATIVE) {
    av_channel_layout_copy(&from, &frame.ch_layout);
  } else {
    av_channel_layout_default(&from, frame.ch_layout.nb_channels);
  }
  SwrContext* resampler = nullptr;
  int code = swr_alloc_set_opts2(&resampler, &to, AV_SAMPLE_FMT_S16, sample_rate_, &from,
                                 static_cast<AVSampleFormat>(frame.format), frame.sample_rate, 0, nullptr);
  resampler_.reset(resampler);
  if (code >= 0 && adaptive_) code = av_opt_set_int(resampler, "flags", SWR_FLAG_RESAMPLE, 0);
  if (code >= 0) code = swr_init(resampler);
  av_channel_layout_uninit(&from);
  begun_ = false;
  next_correction_ = 0;
  if (code >= 0) return {};
  return fail(ErrorCode::kUnsupported, "sound of " + std::to_string(frame.sample_rate) + " Hz with " +
                                           std::to_string(frame.ch_layout.nb_channels) +
                                           " channels cannot be converted");
}

std::int64_t AvSoundTimeline::now() const {
  const std::int64_t appended = av_rescale(count_, AV_TIME_BASE, sample_rate_);
  return begun_ ? appended + swr_get_delay(resampler_.get(), AV_TIME_BASE) : appended;
}

std::int64_t AvSoundTimeline::gap(const AVFrame& frame, std::int64_t begin) const {
  const std::int64_t difference = begin - now();
  if (std::abs(difference) <= (exact_ ? kExactTolerance : kTolerance)) return 0;
  return av_rescale(difference, frame.sample_rate, AV_TIME_BASE);
}

Result<void> AvSoundTimeline::follow(const AVFrame& frame, std::int64_t begin,
                                     std::vector<std::int16_t>& out) {
  const std::int64_t time = now();
  drift_ += (static_cast<double>(begin - time) - drift_) * kMeanWeight;
  if (std::abs(drift_) < kDriftTolerance || time < next_correction_) return {};
  if (!adaptive_) {
    adaptive_ = true;
    drain(out);
    if (auto opened = open(frame); !opened) return opened;
  }
  const double greatest = kGreatestStretch * kCorrection;
  const double correction = std::clamp(drift_ * kCorrectionShare, -greatest, greatest);
  const auto samples = static_cast<int>(std::lround(correction * sample_rate_ / AV_TIME_BASE));
  swr_set_compensation(resampler_.get(), samples, sample_rate_);
  next_correction_ = time + kCorrection;
  return {};
}

void AvSoundTimeline::add_silence(const AVFrame& frame, int samples, std::vector<std::int16_t>& out) {
  const auto format = static_cast<AVSampleFormat>(frame.format);
  const int channels = frame.ch_layout.nb_channels;
  std::uint8_t** data = nullptr;
  if (av_samples_alloc_array_and_samples(&data, nullptr, channels, samples, format, 0) < 0) return;
  av_samples_set_silence(data, 0, samples, channels, format);
  std::vector<const std::uint8_t*> planes(data, data + (av_sample_fmt_is_planar(format) != 0 ? channels : 1));
  convert(planes.data(), samples, out);
  av_freep(&data[0]);
  av_freep(&data);
}

void AvSoundTimeline::add(const AVFrame& frame, int skipped, std::vector<std::int16_t>& out) {
  const auto format = static_cast<AVSampleFormat>(frame.format);
  const bool planar = av_sample_fmt_is_planar(format) != 0;
  const int channels = frame.ch_layout.nb_channels;
  const std::ptrdiff_t step =
      static_cast<std::ptrdiff_t>(av_get_bytes_per_sample(format)) * (planar ? 1 : channels);
  std::vector<const std::uint8_t*> planes(frame.extended_data, frame.extended_data + (planar ? channels : 1));
  for (const std::uint8_t*& plane : planes) plane += skipped * step;
  if (skipped < frame.nb_samples) convert(planes.data(), frame.nb_samples - skipped, out);
  if (skipped < frame.nb_samples) exact_ = false;
}

void AvSoundTimeline::drain(std::vector<std::int16_t>& out) {
  if (begun_) convert(nullptr, 0, out);
  begun_ = false;
}

void AvSoundTimeline::convert(const std::uint8_t** data, int samples, std::vector<std::int16_t>& out) {
  const int capacity = swr_get_out_samples(resampler_.get(), samples);
  if (capacity <= 0) return;
  const std::size_t before = out.size();
  const auto width = static_cast<std::size_t>(channels_);
  out.resize(before + static_cast<std::size_t>(capacity) * width);
  auto* to = reinterpret_cast<std::uint8_t*>(out.data() + before);
  const int converted = std::max(swr_convert(resampler_.get(), &to, capacity, data, samples), 0);
  out.resize(before + static_cast<std::size_t>(converted) * width);
  count_ += converted;
  begun_ = true;
}

}  // namespace fbs
