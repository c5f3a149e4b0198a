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

/// How long the motion of a damaged stream stands still at most.
constexpr double kKeySeconds = 8;

}  // namespace

SceneTiming::SceneTiming(const VideoFormat& format, const EncoderSettings& settings)
    : nominal_duration(fbs::nominal_duration(format.frame_rate)) {
  const double fps = fps_of(format);
  group_pictures = settings.group_pictures > 0
                       ? settings.group_pictures
                       : std::clamp(static_cast<int>(std::lround(fps)), 1, kMaxGroupPictures);
  if (settings.live) {
    const double delay = settings.live->delay, groups = std::ceil(delay / kLiveGroupSeconds);
    group_pictures = std::clamp(static_cast<int>(std::lround(fps * delay / groups)), 1, kMaxGroupPictures);
  }
  if (settings.key_interval > 0) {
    const double others = std::floor(fps * settings.key_interval) - 1;  // the first has a group of its own
    group_pictures = static_cast<std::size_t>(std::clamp(others, 1.0, static_cast<double>(group_pictures)));
  }
  const bool each = settings.live && settings.live->resilience != Resilience::kNone;
  repeats_moved = settings.live && settings.live->resilience == Resilience::kStrong;
  groups_per_key =
      each ? 1 : std::max(1, static_cast<int>(kKeySeconds * fps / static_cast<double>(group_pictures)));
  lookahead = std::max(1, static_cast<int>(std::lround(fps * kLookaheadSeconds)));
}

}  // namespace fbs
