// The sound of the player, and how pictures keep to it.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "cli/play/player.h"
#include "common/picture.h"
#include "decoder/sound/sound_decoder.h"

namespace fbs::cli {
namespace {}  // namespace

Result<void> Player::open_sound() {
  read_sound();
  if (arguments_.no_sound) return {};
  std::optional<SoundSetup> setup = decoder().sound_setup();
  if (!setup && !parts_.all().empty()) setup = parts_.all().front().setup;
  if (!setup) return {};
  const auto codec = SoundDecoder::create(*setup);
  if (!codec) return {};  // SPEC 4.9: left out
  sound_.emplace(parts_, (*codec)->sample_rate(), (*codec)->channels());
  return {};
}

void Player::open_device() {
  if (!sound_) return;
  // NOLINTNEXTLINE(concurrency-mt-unsafe): no thread changes the environment
  if (const char* const name = std::getenv("FBS_PLAY_TIMES")) times_.open(name);
  auto device = SoundDevice::open(sound_->queue());
  if (device)
    device_.emplace(std::move(*device));
  else
    std::fprintf(stderr, "fbs: %s; playing without sound\n", device.error().text.c_str());
}

void Player::read_sound() {
  const auto kept = file_->kept();
  if (kept.size() > parts_read_) parts_.add(kept.subspan(parts_read_));
  parts_read_ = std::max(parts_read_, kept.size());
  if (!peek_ || length_) return;
  // Of a pipe no more is read than pictures need. The sound of the next ones must not wait for them, or it
  // would stop wherever a group ends.
  const std::vector<std::uint8_t> coming = peek_->bytes();
  const std::size_t known = parts_read_ - kept.size();
  if (coming.size() <= known) return;
  parts_.add(std::span(coming).subspan(known));
  parts_read_ += coming.size() - known;
}

void Player::stop_sound() {
  if (!device_ || !sound_->started()) return;
  device_->run(false);
  sound_->stop();
}

void Player::update_sound() {
  if (!device_ || quits_ || wanted_ || !playback_.is_running() || decoder().pictures() == 0) return;
  const Rational rate = decoder().format().frame_rate;
  const StreamPosition& begin = decoder().position();
  const StreamPosition end{begin.pictures + 1, begin.time + decoder().duration()};
  const bool starts = !sound_->started();
  if (starts && !(drawn_ && shown_)) return;  // not before its picture is seen
  read_sound();
  if (starts) sound_->start(sound_time(begin, rate));
  // Sound comes before its pictures; of a file that has been read, all that there is.
  const std::int64_t come = parts_.all().empty() ? 0 : end_of(parts_.all().back());
  sound_->fill(length_ ? std::numeric_limits<std::int64_t>::max() : std::max(come, sound_time(end, rate)));
  if (starts) device_->run(true);

  const auto now = Playback::Clock::now();
  const std::int64_t since = sound_->heard(now) - sound_time(begin, rate);
  const std::int64_t time = static_cast<std::int64_t>(begin.time) + since * kTicksPerSecond / kSoundClock;
  playback_.follow(static_cast<std::uint64_t>(std::max<std::int64_t>(time, 0)), now);
}

SoundSpan Player::sound_of_picture() const {
  const StreamPosition& begin = decoder().position();
  if (!playback_.is_running()) return {};
  const Rational rate = decoder().format().frame_rate;
  return {sound_time(begin, rate), sound_time({begin.pictures + 1, begin.time + decoder().duration()}, rate)};
}

void Player::log_times() {
  if (!times_.is_open() || !device_ || !sound_->started()) return;
  const StreamPosition& shown = decoder().position();
  times_ << shown.pictures << ' ' << sound_time(shown, decoder().format().frame_rate) << ' '
         << sound_->heard(Playback::Clock::now()) << std::endl;
}

void Player::take_sound_key(const KeyPress& press) {
  shown_ = false;
  if (!device_) return;
  if (press.action == Action::kMute)
    sound_->toggle_mute();
  else
    sound_->change_volume(press.amount);
}

std::string Player::sound_text() const {
  return device_ ? sound_->volume_text() : "";
}

}  // namespace fbs::cli
