#include "cli/play/sound/sound_playback.h"

#include <algorithm>

#include "bitstream/sound_time.h"
#include "cli/video/timestamps.h"
#include "common/picture.h"

namespace fbs::cli {

namespace {

/// Duration of `count` pictures less the sum of their rounded nominal durations. 1/90000 s.
/// @param count  0..kMaxStreamPictures: the product with a duration would not fit into 64 bits
std::int64_t rounding(std::int64_t count, Rational rate) {
  const std::int64_t nominal = nominal_duration(rate), period = rate.num, rest = count % period;
  const std::int64_t of_period = kTicksPerSecond * rate.den - period * nominal;
  return count / period * of_period + regular_pts(rest, rate) - rest * nominal;
}

}  // namespace

std::int64_t sound_time(const StreamPosition& position, Rational rate) {
  auto ticks = static_cast<std::int64_t>(position.time);
  if (plausible_rate(rate)) ticks += rounding(static_cast<std::int64_t>(position.pictures), rate);
  return fbs::sound_time(std::max<std::int64_t>(ticks, 0));
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
