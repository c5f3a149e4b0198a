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

/// A time, 1/90000 s, to which exactly this many pictures of nominal duration are nearest.
/// @param pictures  nearest to `seconds`, or the limit, at least 1
std::uint64_t ticks_for(double seconds, double pictures, std::uint32_t nominal_duration) {
  constexpr double kMost = 1e18;  // twice as much fits into 64 bits
  const double least = pictures > 1 ? (pictures - 0.5) * nominal_duration : 1;
  const double most = (pictures + 0.5) * nominal_duration - 1;
  const double ticks = std::min(std::max(kTicksPerSecond * seconds, least), most);
  return static_cast<std::uint64_t>(std::ceil(std::min(ticks, kMost)));
}

/// Whether another picture like the last would end farther from the wanted time.
bool is_nearest(std::uint64_t lasts, std::uint32_t last, std::uint64_t wanted) {
  return 2 * lasts + last > 2 * wanted;
}

}  // namespace

SceneTiming::SceneTiming(const VideoFormat& format, const EncoderSettings& settings)
    : key_ticks(0), group_ticks(0), nominal_duration(fbs::nominal_duration(format.frame_rate)) {
  const double fps = fps_of(format), key_interval = key_interval_of(settings);
  key_pictures = key_interval > 0 ? std::max(1LL, std::llround(fps * key_interval)) : 0;
  if (key_pictures > 0)
    key_ticks = ticks_for(key_interval, static_cast<double>(key_pictures), nominal_duration);
  group_pictures = settings.group_pictures > 0
                       ? settings.group_pictures
                       : std::clamp(static_cast<int>(std::lround(fps)), 1, kMaxGroupPictures);
  if (settings.live) {
    const double delay = settings.live->delay, groups = std::ceil(delay / kLiveGroupSeconds);
    group_pictures = std::clamp(static_cast<int>(std::lround(fps * delay / groups)), 1, kMaxGroupPictures);
    group_ticks = ticks_for(delay / groups, static_cast<double>(group_pictures), nominal_duration);
  }
  const bool each = settings.live && settings.live->resilience != Resilience::kNone;
  repeats_moved = settings.live && settings.live->resilience == Resilience::kStrong;
  groups_per_key =
      each ? 1 : std::max(1, static_cast<int>(kKeySeconds * fps / static_cast<double>(group_pictures)));
  lookahead = std::max(1, static_cast<int>(std::lround(fps * kLookaheadSeconds)));
}

bool SceneTiming::group_ends(std::size_t in_group, std::uint64_t lasts, std::uint32_t last,
                             std::uint64_t in_scene) const {
  if (in_scene == 1) return true;
  if (group_ticks == 0) return in_group == group_pictures;
  return is_nearest(lasts, last, group_ticks) || in_group == kMaxGroupPictures;
}

bool SceneTiming::scene_is_full(std::uint64_t lasts, std::uint32_t last) const {
  return key_ticks > 0 && is_nearest(lasts, last, key_ticks);
}

}  // namespace fbs
