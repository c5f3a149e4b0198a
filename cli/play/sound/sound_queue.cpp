#include "cli/play/sound/sound_queue.h"

#include <algorithm>
#include <cmath>

#include "bitstream/sound_syntax.h"

namespace fbs::cli {

void SoundQueue::restart(std::int64_t time) {
  const std::lock_guard lock(mutex_);
  samples_.clear();
  runs_.clear();
  begin_ = time;
  next_ = heard_ = 0;
}

void SoundQueue::add(std::span<const std::int16_t> samples) {
  const std::lock_guard lock(mutex_);
  samples_.insert(samples_.end(), samples.begin(), samples.end());
}

void SoundQueue::fetch(std::span<std::int16_t> out, Time now) {
  const std::lock_guard lock(mutex_);
  const auto count = static_cast<std::ptrdiff_t>(std::min(out.size(), samples_.size()));
  const auto louder = [&](std::int16_t sample) {
    return static_cast<std::int16_t>(std::lround(gain_ * sample));
  };
  const auto silence = std::transform(samples_.begin(), samples_.begin() + count, out.begin(), louder);
  std::fill(silence, out.end(), std::int16_t{0});
  samples_.erase(samples_.begin(), samples_.begin() + count);

  const std::int64_t taken = count / channels_;
  const bool goes_on = !runs_.empty() && runs_.back().fetched + runs_.back().count == fetched_;
  if (goes_on)
    runs_.back().count += taken;
  else if (taken > 0)
    runs_.push_back({fetched_, next_, taken});
  next_ += taken;
  block_ = static_cast<std::int64_t>(out.size()) / channels_;
  block_time_ = now;
  fetched_ += block_;
}

std::int64_t SoundQueue::heard_sample(Time now) {
  const std::chrono::duration<double> since = now - block_time_;
  const auto played =
      static_cast<std::int64_t>(std::clamp(since.count() * rate_, 0.0, 1.0 * static_cast<double>(block_)));
  const std::int64_t place = fetched_ - 2 * block_ + played;
  while (runs_.size() > 1 && runs_[1].fetched <= place) runs_.pop_front();
  if (runs_.empty()) return 0;
  const Run& run = runs_.front();
  return run.sample + std::clamp<std::int64_t>(place - run.fetched, 0, run.count);
}

std::int64_t SoundQueue::heard(Time now) {
  const std::lock_guard lock(mutex_);
  heard_ = std::max(heard_, heard_sample(now));
  return begin_ + heard_ * kSoundClock / rate_;
}

std::int64_t SoundQueue::waiting() const {
  const std::lock_guard lock(mutex_);
  return static_cast<std::int64_t>(samples_.size()) / channels_;
}

void SoundQueue::set_gain(double gain) {
  const std::lock_guard lock(mutex_);
  gain_ = gain;
}

}  // namespace fbs::cli
