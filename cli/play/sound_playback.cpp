#include "cli/play/sound_playback.h"

#include <algorithm>

#include "cli/video/timestamps.h"
#include "common/picture.h"

namespace fbs::cli {

std::int64_t sound_time(const StreamPosition& position, Rational rate) {
  auto ticks = static_cast<std::int64_t>(position.time);
  if (plausible_rate(rate)) {
    const auto count = static_cast<std::int64_t>(position.pictures);
    ticks += regular_pts(count, rate) - count * nominal_duration(rate);
  }
  return std::max<std::int64_t>(ticks, 0) * kSoundClock / kTicksPerSecond;
}

void Volume::change(int steps) {
  percent_ = std::clamp(percent_ + steps * kStep, 0, 100);
  muted_ = false;
}

double Volume::gain() const {
  return muted_ ? 0 : percent_ / 100.0 * percent_ / 100.0;
}

std::string Volume::text() const {
  if (muted_) return "muted";
  return percent_ < 100 ? "volume " + std::to_string(percent_) + " %" : "";
}

void SoundPlayback::start(std::int64_t time) {
  cursor_.seek(time);
  queue_.restart(time);
  started_ = true;
}

void SoundPlayback::stop() {
  queue_.restart(0);
  started_ = false;
}

void SoundPlayback::fill(std::int64_t known) {
  const std::int64_t waiting = queue_.waiting() * kSoundClock / queue_.sample_rate();
  const std::int64_t ahead = kAhead.count() * kSoundClock - waiting;
  const std::int64_t end = std::min(known, cursor_.time() + ahead);
  if (end > cursor_.time()) queue_.add(cursor_.take(end));
}

void SoundPlayback::change_volume(int steps) {
  volume_.change(steps);
  queue_.set_gain(volume_.gain());
}

void SoundPlayback::toggle_mute() {
  volume_.toggle_mute();
  queue_.set_gain(volume_.gain());
}

}  // namespace fbs::cli
