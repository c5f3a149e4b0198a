#include "cli/video/av/av_source.h"

extern "C" {
#include <libavutil/display.h>
}

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "cli/program/module.h"
#include "cli/video/av/av_colour.h"
#include "cli/video/av/av_filter.h"
#include "cli/video/av/av_picture.h"
#include "cli/video/av/av_track.h"
#include "cli/video/orientation.h"
#include "cli/video/picture_size.h"
#include "cli/video/timestamps.h"

namespace fbs {
namespace {

constexpr Rational kUnknownRate{25, 1};

Rational as_rational(AVRational value) {
  if (value.num <= 0 || value.den <= 0) return {0, 1};
  return {static_cast<std::uint32_t>(value.num), static_cast<std::uint32_t>(value.den)};
}

/// The nominal rate when it agrees with the mean, else the mean: for variable rates the nominal one is only
/// the finest grid that contains all timestamps.
Rational choose_frame_rate(AVFormatContext* container, AVStream* stream) {
  const AVRational nominal = av_guess_frame_rate(container, stream, nullptr);
  const AVRational mean = stream->avg_frame_rate;
  const bool mean_known = mean.num > 0 && mean.den > 0;
  const bool agree = !mean_known || std::abs(av_q2d(nominal) / av_q2d(mean) - 1) < 0.1;
  AVRational rate = agree ? nominal : mean;
  av_reduce(&rate.num, &rate.den, rate.num, rate.den, kMaxRatePart);
  return plausible_rate(as_rational(rate)) ? as_rational(rate) : kUnknownRate;
}

/// 1/AV_TIME_BASE s.
std::int64_t start_time(const AVFormatContext& container) {
  return container.start_time == AV_NOPTS_VALUE ? 0 : container.start_time;
}

std::optional<Orientation> orientation_of(const std::uint8_t* matrix_bytes, std::size_t size) {
  std::array<std::int32_t, 9> matrix{};
  if (matrix_bytes == nullptr || size < sizeof matrix) return std::nullopt;
  std::memcpy(matrix.data(), matrix_bytes, sizeof matrix);
  return orientation_from_matrix(matrix);
}

/// The container's display matrix, or else the one inside the stream.
Orientation orientation_of(const AVStream& stream, const AVFrame& frame) {
  std::size_t size = 0;
  const std::uint8_t* in_stream = av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, &size);
  if (const auto found = orientation_of(in_stream, size)) return *found;
  const AVFrameSideData* in_frame = av_frame_get_side_data(&frame, AV_FRAME_DATA_DISPLAYMATRIX);
  if (in_frame == nullptr) return {};
  return orientation_of(in_frame->data, in_frame->size).value_or(Orientation{});
}

class AvSource final : public VideoSource {
 public:
  explicit AvSource(std::string name) : track_(std::move(name)) {}

  Result<void> open(const SourceOptions& options);

  [[nodiscard]] const VideoFormat& format() const override { return format_; }
  Result<std::optional<TimedPicture>> next() override;
  [[nodiscard]] std::optional<std::int64_t> frame_count_estimate() const override;
  [[nodiscard]] std::optional<double> seconds_estimate() const override;
  [[nodiscard]] std::int64_t damaged_packets() const override { return track_.damaged_packets(); }
  [[nodiscard]] std::vector<std::string> notes() const override;
  /// Time of the picture that open() has decoded, on the container's own clock, 1/AV_TIME_BASE s.
  [[nodiscard]] std::int64_t first_picture_time() const;

 private:
  Result<void> open_decoder(const SourceOptions& options);
  void describe(const AVFrame& first);
  /// Length according to the container, pictures of the frame rate.
  [[nodiscard]] std::optional<std::int64_t> regular_pictures() const;
  /// Prepares the conversion of HDR and wide colours to BT.709. Without it they are encoded as they are.
  void convert_colours(const AVFrame& first);
  std::int64_t next_pts();
  [[nodiscard]] std::int64_t on_regular_grid(std::int64_t pts) const;

  AvTrack track_;
  std::unique_ptr<FrameFilter> filter_;  ///< null: none is needed
  std::string colour_note_;              ///< empty: colours are as in the source
  FramePicture converter_;
  VideoFormat format_;
  Orientation orientation_;
  bool frame_waiting_ = false;  ///< the track's frame has not been returned
  std::int64_t index_ = 0;
  std::int64_t first_pts_ = 0;
  std::int64_t last_pts_ = 0;
};

Result<void> AvSource::open(const SourceOptions& options) {
  if (const int code = track_.open(options.stop); code < 0) {
    const bool other_kind = code == AVERROR_INVALIDDATA || code == AVERROR_PROTOCOL_NOT_FOUND;
    return fail(other_kind ? ErrorCode::kUnsupported : ErrorCode::kIo,
                "cannot read " + track_.name() + ": " +
                    (other_kind ? "not a video that we know, or cut off before its index" : av_reason(code)));
  }
  if (auto opened = open_decoder(options); !opened) return opened;
  const auto decoded = track_.decode();
  if (!decoded) return fail(decoded.error());
  if (!*decoded) return track_.error(ErrorCode::kUnsupported, "contains no picture that can be decoded");
  frame_waiting_ = true;
  describe(track_.frame());
  return check_picture_size(track_.name(), format_.width, format_.height);
}

Result<void> AvSource::open_decoder(const SourceOptions& options) {
  const AVCodec* codec = nullptr;
  const int index = av_find_best_stream(&track_.container(), AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
  if (index == AVERROR_DECODER_NOT_FOUND)
    return track_.error(ErrorCode::kUnsupported, "no decoder for its video");
  if (index < 0) return track_.error(ErrorCode::kUnsupported, "holds no video");
  if ((track_.container().streams[index]->disposition & AV_DISPOSITION_ATTACHED_PIC) != 0) {
    return track_.error(ErrorCode::kUnsupported, "holds no video, only a cover picture");
  }
  return track_.choose(index, *codec, std::max(options.decoder_threads, 1), "video");
}

void AvSource::describe(const AVFrame& first) {
  orientation_ = orientation_of(track_.stream(), first);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): libav only reads the frame
  auto* const frame = const_cast<AVFrame*>(&first);
  const AVRational aspect = av_guess_sample_aspect_ratio(&track_.container(), &track_.stream(), frame);
  format_.width = first.width;
  format_.height = first.height;
  format_.frame_rate = choose_frame_rate(&track_.container(), &track_.stream());
  format_.pixel_aspect = as_rational(aspect);
  format_.range = colour_range(first);
  format_.matrix = colour_matrix(first);
  if (orientation_.transposed) {
    std::swap(format_.width, format_.height);
    const bool known = format_.pixel_aspect.num != 0;
    if (known) std::swap(format_.pixel_aspect.num, format_.pixel_aspect.den);
  }
  convert_colours(first);
}

void AvSource::convert_colours(const AVFrame& first) {
  const auto conversion = colour_conversion(track_.stream(), first);
  if (!conversion) return;
  const auto open = load_module_function<OpenFilterFunction>(kAvFilterModule, kOpenFilterSymbol);
  Result<std::unique_ptr<FrameFilter>> filter;
  if (open)
    (*open)(first, conversion->graph, filter);
  else
    filter = fail(open.error());
  if (!filter) {
    colour_note_ = conversion->from + " is not converted to BT.709, and looks pale: " + filter.error().text;
    return;
  }
  filter_ = std::move(*filter);
  colour_note_ = conversion->from + (conversion->hdr ? " tone-mapped to BT.709" : " converted to BT.709");
  format_.range = ColourRange::kLimited;
  format_.matrix = ColourMatrix::kBt709;
}

std::vector<std::string> AvSource::notes() const {
  std::vector<std::string> notes;
  if (!colour_note_.empty()) notes.push_back(colour_note_);
  if (converter_.was_transparent()) notes.emplace_back(kOverBlack);
  return notes;
}

Result<std::optional<TimedPicture>> AvSource::next() {
  if (!std::exchange(frame_waiting_, false)) {
    const auto decoded = track_.decode();
    if (!decoded) return fail(decoded.error());
    if (!*decoded) return std::nullopt;
  }
  const bool lies = orientation_.transposed;
  AVFrame& decoded = track_.frame();
  const int width = lies ? decoded.height : decoded.width, height = lies ? decoded.width : decoded.height;
  if (width != format_.width || height != format_.height)
    return size_change(track_.name(), format_, width, height);
  Result<const AVFrame*> frame = &decoded;
  if (filter_) frame = filter_->filter(decoded);
  auto picture = frame.and_then([&](const AVFrame* f) { return converter_.convert(*f); });
  if (!picture) return track_.error(picture.error().code, picture.error().text);
  TimedPicture timed{oriented(std::move(*picture), orientation_), next_pts()};
  ++index_;
  return timed;
}

std::int64_t AvSource::first_picture_time() const {
  return track_.frame_time(kTimeBase).value_or(start_time(track_.container()));
}

std::int64_t AvSource::next_pts() {
  std::int64_t pts = last_pts_ + regular_pts(1, format_.frame_rate);
  if (const auto time = track_.frame_time(kTick)) {
    pts = *time - av_rescale(start_time(track_.container()), kTicksPerSecond, AV_TIME_BASE);
  } else if (index_ == 0) {
    pts = 0;
  }
  if (index_ == 0) first_pts_ = pts;
  pts = on_regular_grid(pts);
  if (index_ > 0) pts = std::max(pts, last_pts_ + 1);
  last_pts_ = pts;
  return pts;
}

std::int64_t AvSource::on_regular_grid(std::int64_t pts) const {
  const std::int64_t unit = av_rescale_rnd(track_.stream().time_base.num, kTicksPerSecond,
                                           track_.stream().time_base.den, AV_ROUND_UP);
  const std::int64_t tolerance = std::min(unit, regular_pts(1, format_.frame_rate) / 4);
  const std::int64_t elapsed = pts - first_pts_;
  if (elapsed < 0) return pts;
  const Rational rate = format_.frame_rate;
  const std::int64_t nearest =
      av_rescale(elapsed, rate.num, kTicksPerSecond * static_cast<std::int64_t>(rate.den));
  const std::int64_t regular = first_pts_ + regular_pts(nearest, rate);
  return std::abs(regular - pts) <= tolerance ? regular : pts;
}

std::optional<std::int64_t> AvSource::regular_pictures() const {
  double seconds = 0;
  if (track_.stream().duration > 0) {
    seconds = static_cast<double>(track_.stream().duration) * av_q2d(track_.stream().time_base);
  } else if (track_.container().duration > 0) {
    seconds = static_cast<double>(track_.container().duration) / AV_TIME_BASE;
  }
  if (seconds <= 0) return std::nullopt;
  return std::llround(seconds * format_.frame_rate.num / format_.frame_rate.den);
}

std::optional<std::int64_t> AvSource::frame_count_estimate() const {
  if (track_.stream().nb_frames > 0) return track_.stream().nb_frames;
  return regular_pictures();
}

std::optional<double> AvSource::seconds_estimate() const {
  const auto pictures = regular_pictures();
  if (!pictures) return VideoSource::seconds_estimate();
  return static_cast<double>(*pictures) * format_.frame_rate.den / format_.frame_rate.num;
}

}  // namespace

Result<std::unique_ptr<VideoSource>> open_av_source(const std::string& input, const SourceOptions& options) {
  auto source = std::make_unique<AvSource>(input);
  if (auto opened = source->open(options); !opened) return fail(opened.error());
  return source;
}

Result<std::int64_t> first_picture_time(AVFormatContext& container, const std::string& input,
                                        const StopSignal* stop) {
  const int index = av_find_best_stream(&container, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  if (index < 0 || (container.streams[index]->disposition & AV_DISPOSITION_ATTACHED_PIC) != 0) {
    return start_time(container);
  }
  SourceOptions options;
  options.stop = stop;
  AvSource source(input);
  if (auto opened = source.open(options); !opened) return fail(opened.error());
  return source.first_picture_time();
}

}  // namespace fbs
