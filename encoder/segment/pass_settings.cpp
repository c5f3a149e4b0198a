#include "encoder/segment/pass_settings.h"

#include <algorithm>
#include <cmath>

#include "common/workers.h"
#include "encoder/patterns/pattern_size.h"
#include "encoder/plan/rate_target.h"
#include "encoder/plan/scene_timing.h"

namespace fbs {
namespace {

/// Default of a live stream, s.
constexpr double kLiveStart = 1;

/// Steps of the quantiser: where no pattern comes from the future, fewer and finer ones pay.
constexpr int kLiveFiner = 2;

/// The same for windows, from quality 50 to 0, or to 100: there patterns come when they pay, and their
/// quantiser decides how many. Without, claire at 4 s spans 27 to 29 dB in the face, a file 25 to 31.
constexpr double kWindowSteps = 12;

/// EncoderSettings::start, s; 0: none.
double start_of(const EncoderSettings& settings) {
  const bool by_default = settings.bitrate > 0 && settings.live && !settings.live->relies_on_first();
  return settings.start.value_or(by_default ? std::min(kLiveStart, settings.live->buffer) : 0);
}

LivePatternSettings live_settings(const PatternSettings& common, const EncoderSettings& settings,
                                  const VideoFormat& format) {
  LivePatternSettings out{common};
  out.delay = settings.live->delay;
  const Effort effort = Effort::of(settings.effort);
  out.solves = effort.solves;
  out.reduced = settings.reduced_patterns.value_or(large_enough_to_reduce(format));
  const int halvings = out.reduced ? 1 : 0;
  const PatternPoint point = PatternPoint::at(settings.quality);
  out.quantiser = settings.pattern_quantiser >= 0
                      ? settings.pattern_quantiser
                      : quantiser_of(point, format.width >> halvings, format.height >> halvings) - kLiveFiner;
  if (settings.pattern_quantiser < 0 && LivePatterns::has_windows(out.delay))
    out.quantiser += static_cast<int>(std::lround(kWindowSteps * (50 - settings.quality) / 50));
  out.refits = effort.refits > 0 && !settings.track_only;
  out.buffer = settings.live->buffer;
  out.alone = settings.live->resilience == Resilience::kStrong;
  // A lossy link may lose the finer pattern, and the patterns predicted from it become useless. In windows
  // the gain is less than what it costs: man_glasses takes 40 % more at 1 s.
  out.refines =
      settings.live->resilience == Resilience::kNone && !LivePatterns::has_windows(settings.live->delay);
  out.threads = std::max(1, common.threads - 1);  // one is the analysis's
  return out;
}

}  // namespace

int thread_count(const EncoderSettings& settings) {
  return settings.threads > 0 ? settings.threads : core_count();
}

RateTarget motion_target(const EncoderSettings& settings, double eye_distance_px) {
  RateTarget target = rate_target(settings, eye_distance_px);
  if (settings.patterns == 1) return target;
  target.quality = settings.bitrate > 0 ? motion_quality_at(settings.bitrate, settings.live.has_value())
                                        : PatternPoint::at(settings.quality).motion_quality;
  target.bitrate_kbps = 0;  // patterns take the rest of the rate
  return target;
}

FilePatternSettings pass_settings(const EncoderSettings& settings, const OperatingPoint& motion) {
  FilePatternSettings out;
  if (settings.tune == Tune::kEye) out.point_at = &PatternPoint::by_eye;
  out.point = out.point_at(settings.quality);
  out.count = settings.patterns;
  if (settings.pattern_quantiser >= 0) out.quantiser = settings.pattern_quantiser;
  out.lone_quantiser = settings.pattern_quantiser < 0 ? motion.pattern_quantiser : settings.pattern_quantiser;
  out.reduced = settings.reduced_patterns;
  out.bitrate_kbps = settings.bitrate;
  out.start = start_of(settings);
  out.threads = thread_count(settings);
  out.hooks = settings.hooks;
  out.lambda = motion.lambda;
  out.effort = Effort::of(settings.effort);
  if (settings.track_only) out.effort.refits = 0;
  return out;
}

FilePatternSettings planar_pass_settings(const EncoderSettings& settings, const OperatingPoint& motion) {
  FilePatternSettings out = pass_settings(settings, motion);
  out.point_at = &PatternPoint::without_face;
  out.point = out.point_at(settings.quality);
  out.without_face = true;
  out.effort.refits = 0;
  return out;
}

std::unique_ptr<PatternStage> pattern_stage(FilePatternSettings pass, const EncoderSettings& settings,
                                            const VideoFormat& format, const CodedState& rest) {
  pass.groups_per_key = SceneTiming(format, settings).groups_per_key;
  if (!settings.live) {
    auto out = std::make_unique<PatternStage>(format, pass, rest);
    out->decide_by(std::make_unique<FilePatterns>(*out, pass));
    return out;
  }
  const LivePatternSettings live = live_settings(pass, settings, format);
  auto out = std::make_unique<PatternStage>(format, live, rest);
  // A rate is kept by what waits to be sent, not over a whole scene.
  const bool knows_scenes = LivePatterns::has_windows(live.delay) && live.bitrate_kbps == 0 && !live.alone;
  out->decide_by(std::make_unique<LivePatterns>(*out, live),
                 knows_scenes ? std::make_unique<FilePatterns>(*out, pass) : nullptr);
  return out;
}

}  // namespace fbs
