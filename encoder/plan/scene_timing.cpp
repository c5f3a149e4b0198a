#include "encoder/plan/scene_timing.h"

#include <algorithm>
#include <cmath>

#include "bitstream/syntax.h"

namespace fbs {
namespace {

/// How much is observed before the surround's map and the mouth's colours are fixed. Longer sees more open
/// mouths and more motion, but delays the first bytes.
constexpr double kLookaheadSeconds = 2;

/// Longest group of a live scene.
constexpr double kLiveGroupSeconds = 1;

/// Default time between scenes of a live source, s: where viewers join. Twice as long where the head of each
/// is sent again, and longer where viewers can join anywhere.
constexpr double kLiveKeySeconds = 10, kStrongKeySeconds = 20, kJoinedKeySeconds = 40;

/// How long the motion of a damaged stream stands still at most.
constexpr double kKeySeconds = 8;

double key_interval_of(const EncoderSettings& settings) {
  if (!settings.live || settings.key_interval > 0) return settings.key_interval;
  if (settings.live->join > 0) return kJoinedKeySeconds;
  return settings.live->resilience == Resilience::kStrong ? kStrongKeySeconds : kLiveKeySeconds;
}

}  // namespace

SceneTiming::SceneTiming(const VideoFormat& format, const EncoderSettings& settings)
    : nominal_duration(fbs::nominal_duration(format.frame_rate)) {
  const double fps = fps_of(format), key_interval = key_interval_of(settings);
  key_pictures = key_interval > 0 ? std::max(1LL, std::llround(fps * key_interval)) : 0;
  group_pictures = settings.group_pictures > 0
                       ? settings.group_pictures
                       : std::clamp(static_cast<int>(std::lround(fps)), 1, kMaxGroupPictures);
  if (settings.live) {
    const double delay = settings.live->delay, groups = std::ceil(delay / kLiveGroupSeconds);
    group_pictures = std::clamp(static_cast<int>(std::lround(fps * delay / groups)), 1, kMaxGroupPictures);
  }
  const bool each = settings.live && settings.live->resilience != Resilience::kNone;
  repeats_moved = settings.live && settings.live->resilience == Resilience::kStrong;
  groups_per_key =
      each ? 1 : std::max(1, static_cast<int>(kKeySeconds * fps / static_cast<double>(group_pictures)));
  lookahead = std::max(1, static_cast<int>(std::lround(fps * kLookaheadSeconds)));
}

}  // namespace fbs
