#include "cli/play/playback.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

#include "common/picture.h"

namespace fbs::cli {
namespace {

using Ticks = std::chrono::duration<std::int64_t, std::ratio<1, kTicksPerSecond>>;

}  // namespace

Playback::Time Playback::wall_time(std::uint64_t stream) const {
  const Ticks ahead(static_cast<std::int64_t>(stream) - static_cast<std::int64_t>(anchor_->stream));
  return anchor_->wall + std::chrono::duration_cast<Clock::duration>(ahead);
}

void Playback::take(std::uint64_t begin, std::uint32_t duration, Time now) {
  ended_ = false;
  // A picture that begins after the end of the last one leaves a gap of lost pictures: do not wait for it.
  const bool gap = anchor_ && begin > end_;
  const bool slows_down = anchor_ && !follows_ && now > wall_time(begin) + kMostLate;
  if (!anchor_ || paused_ || gap || slows_down) anchor_ = Anchor{begin, now};
  begin_ = begin;
  end_ = begin + duration;
}

void Playback::follow(std::uint64_t stream, Time now) {
  anchor_ = Anchor{stream, now};
  follows_ = true;
}

void Playback::jump() {
  anchor_.reset();
  follows_ = false;
}

void Playback::pause(bool paused, Time now) {
  if (paused_ != paused) follows_ = false;
  if (paused_ && !paused) anchor_ = Anchor{begin_, now};
  paused_ = paused;
}

Playback::Clock::duration Playback::until_due(Time now) const {
  if (!anchor_) return Clock::duration::zero();
  return std::max(Clock::duration::zero(), wall_time(end_) - now);
}

bool Playback::is_late(Time now) const {
  if (!is_running() || !anchor_ || now < wall_time(end_)) return false;
  return drawn_ && now - *drawn_ < kMostSkipped;
}

std::string clock_text(std::uint64_t ticks) {
  const std::uint64_t hundredths = ticks * 100 / kTicksPerSecond, seconds = hundredths / 100;
  std::array<char, 64> text{};
  const auto part = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  if (seconds >= 3600)
    std::snprintf(text.data(), text.size(), "%llu:%02llu:%02llu.%02llu", part(seconds / 3600),
                  part(seconds / 60 % 60), part(seconds % 60), part(hundredths % 100));
  else
    std::snprintf(text.data(), text.size(), "%llu:%02llu.%02llu", part(seconds / 60), part(seconds % 60),
                  part(hundredths % 100));
  return text.data();
}

}  // namespace fbs::cli
