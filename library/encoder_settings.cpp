#include "library/encoder_settings.h"

#include <cstring>

#include "library/settings_struct.h"

namespace fbs {
namespace {

constexpr double kMaxSeconds = 1e8;  ///< three years: products with rates stay far from overflow
constexpr double kMaxKbitPerSecond = 1e6;

/// Also false for NaN.
bool within(double value, double max) {
  return value >= 0 && value <= max;
}

Result<VideoFormat> video_format(const fbs_format& format) {
  if (format.width < FBS_MIN_SIDE || format.width > FBS_MAX_SIDE || format.height < FBS_MIN_SIDE ||
      format.height > FBS_MAX_SIDE)
    return fail(ErrorCode::kInvalidArgument, "width or height outside 64..8192");
  int matrix = 0;  // a caller may pass a value outside the enumeration
  static_assert(sizeof matrix == sizeof format.matrix);
  std::memcpy(&matrix, &format.matrix, sizeof matrix);
  if (matrix < FBS_MATRIX_UNSPECIFIED || matrix > FBS_MATRIX_BT709)
    return fail(ErrorCode::kInvalidArgument, "the matrix is unknown");
  return VideoFormat{static_cast<int>(format.width),
                     static_cast<int>(format.height),
                     {format.frame_rate_num, format.frame_rate_den},
                     {format.pixel_aspect_num, format.pixel_aspect_den},
                     format.full_range != 0 ? ColourRange::kFull : ColourRange::kLimited,
                     static_cast<ColourMatrix>(matrix)};
}

}  // namespace

static_assert(static_cast<int>(Resilience::kPacket) == FBS_RESILIENCE_PACKET);
static_assert(static_cast<int>(Resilience::kStrong) == FBS_RESILIENCE_STRONG);

Result<EncoderInput> encoder_input(const fbs_encoder_settings& settings) {
  const auto format = video_format(settings.format);
  if (!format) return fail(format.error());
  if (!within(settings.bitrate, kMaxKbitPerSecond))
    return fail(ErrorCode::kInvalidArgument, "bitrate out of range");
  for (const double seconds :
       {settings.seconds, settings.key_interval, settings.live_delay, settings.live_buffer, settings.join,
        settings.start == -1 ? 0 : settings.start})
    if (!within(seconds, kMaxSeconds)) return fail(ErrorCode::kInvalidArgument, "a time out of range");
  if (settings.tune != FBS_TUNE_EYE && settings.tune != FBS_TUNE_PSNR)
    return fail(ErrorCode::kInvalidArgument, "the tune is unknown");
  if (settings.resilience < FBS_RESILIENCE_NONE || settings.resilience > FBS_RESILIENCE_STRONG)
    return fail(ErrorCode::kInvalidArgument, "the resilience is unknown");
  EncoderInput out{*format, {}};
  out.settings.quality = settings.quality;
  out.settings.bitrate = settings.bitrate;
  if (settings.start != -1) out.settings.start = settings.start;
  out.settings.seconds = settings.seconds;
  out.settings.effort = settings.effort;
  out.settings.tune = settings.tune == FBS_TUNE_PSNR ? Tune::kPsnr : Tune::kEye;
  out.settings.patterns = settings.patterns;
  out.settings.face = settings.face;
  out.settings.allow_no_face = settings.allow_no_face != 0;
  out.settings.key_interval = settings.key_interval;
  if (settings.live != 0)
    out.settings.live = LiveSettings{settings.live_delay, settings.live_buffer,
                                     static_cast<Resilience>(settings.resilience), settings.join};
  out.settings.threads = settings.threads;
  out.settings.hooks = hooks_of(settings);
  return out;
}

}  // namespace fbs
