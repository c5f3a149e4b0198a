// The player's sound, and how pictures keep in step with it.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "cli/play/player.h"
#include "common/picture.h"
#include "decoder/sound/sound_decoder.h"

namespace fbs::cli {
namespace {

StreamPosition position_behind(const StreamDecoder& decoder) {
  StreamPosition position = decoder.position();
  position.add(decoder.duration());
  return position;
}

}  // namespace

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
  // A pipe is read only as far as pictures need. The sound of the next ones must not wait for them, or it
  // would stop at the end of every group.
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

std::int64_t Player::sound_come() const {
  if (length_) return std::numeric_limits<std::int64_t>::max();  // everything has been read
  const Rational rate = decoder().format().frame_rate;
  const std::uint64_t released = parts_.released();
  // Pictures held for lost ones are shown although nothing has released them.
  std::int64_t come = sound_time(position_behind(decoder()), rate);
  come = std::max(come, sound_time({released / nominal_duration(rate), released}, rate));
  return parts_.all().empty() ? come : std::max(come, end_of(parts_.all().back()));
}

void Player::update_sound() {
  if (!device_ || quits_ || wanted_ || !playback_.is_running() || decoder().pictures() == 0) return;
  const Rational rate = decoder().format().frame_rate;
  const StreamPosition& begin = decoder().position();
  const bool starts = !sound_->started();
  if (starts && !(drawn_ && shown_)) return;  // not before its picture is visible
  read_sound();
  if (starts) sound_->start(sound_time(begin, rate));
  sound_->fill(sound_come());
  if (starts) device_->run(true);

  const auto now = Playback::Clock::now();
  const std::int64_t since = sound_->heard(now) - sound_time(begin, rate);
  const std::int64_t time = static_cast<std::int64_t>(begin.time) + since * kTicksPerSecond / kSoundClock;
  playback_.follow(static_cast<std::uint64_t>(std::max<std::int64_t>(time, 0)), now);
}

SoundSpan Player::sound_of_picture() const {
  if (!playback_.is_running()) return {};
  const Rational rate = decoder().format().frame_rate;
  return {sound_time(decoder().position(), rate), sound_time(position_behind(decoder()), rate)};
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

}  // namespace fbs::cli
