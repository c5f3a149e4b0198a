#include "cli/play/player.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "cli/video/open/open_video.h"
#include "common/workers.h"
#include "decoder/stream/stream_length.h"

namespace fbs::cli {
namespace {

constexpr std::chrono::milliseconds kIdle{50};  ///< between looks at the clock when nothing is due
constexpr int kMostThreads = 4;                 ///< more would wait for the clock

/// Turn for a drag over the height of the picture, in 2^-16 turns: a quarter turn.
constexpr double kTurnOfDrag = 65536.0 / 4;

std::int32_t turn(double share) {
  return static_cast<std::int32_t>(share * kTurnOfDrag);
}

std::optional<EditPart> edited_part(Action action) {
  switch (action) {
    case Action::kYaw:
      return EditPart::kYaw;
    case Action::kPitch:
      return EditPart::kPitch;
    case Action::kRoll:
      return EditPart::kRoll;
    case Action::kBrows:
      return EditPart::kBrows;
    case Action::kMouth:
      return EditPart::kMouth;
    case Action::kSmile:
      return EditPart::kSmile;
    case Action::kLids:
      return EditPart::kLids;
    default:
      return std::nullopt;
  }
}

}  // namespace

Result<void> Player::open() {
  loops_ = arguments_.loop;
  if (auto opened = open_stream(); !opened) return opened;
  if (!arguments_.source.empty()) {
    auto source = SourceTrack::open(arguments_.source);
    if (!source) return fail(source.error());
    source_.emplace(std::move(*source));
    shows_source_ = true;
  }
  if (auto opened = open_sound(); !opened) return opened;
  // Before the window: an impossible output is an error without one.
  if (auto begun = begin_recording(); !begun) return begun;
  if (auto drawn = stage_.draw(decoder()); !drawn) return drawn;
  const auto first = image();
  if (!first) return fail(first.error());
  auto window = Window::open("fbs: " + arguments_.input, content_of(*first));
  if (!window) return fail(window.error());
  window_.emplace(std::move(*window));
  open_device();
  return {};
}

Result<void> Player::open_stream() {
  auto file = StreamFile::open(arguments_.input);
  if (!file) return fail(file.error());
  file_.emplace(std::move(*file));
  file_->keep_bytes();
  // A file is read as a whole, which gives its length; a pipe only as far as it is played.
  std::error_code ignored;
  const bool whole = std::filesystem::is_regular_file(arguments_.input, ignored);
  if (whole || first_time() > 0)
    if (auto sought = file_->seek(first_time()); !sought) return sought;
  if (whole) length_ = stream_length(file_->kept());
  if (!whole && !arguments_.no_sound) {
    peek_.emplace(arguments_.input);
    parts_.follow_pictures();
  }
  prepare_decoder();
  const auto found = losses_.next(*file_);
  if (!found) return fail(found.error());
  if (*found == DecodeStatus::kEnd)
    return fail(ErrorCode::kInvalidStream, file_->name() + ": contains no pictures");
  const auto now = Playback::Clock::now();
  playback_.pause(arguments_.paused, now);
  playback_.take(decoder().position().time, decoder().duration(), now);
  next_ = decoder().position().time + decoder().duration();
  return {};
}

void Player::prepare_decoder() {
  decoder().record_patterns();
  decoder().use_threads(std::min(core_count(), kMostThreads));
}

Result<void> Player::begin_recording() {
  if (arguments_.record.empty()) return {};
  std::optional<RecordedSound> sound;
  if (sound_ && has_sound_track(arguments_.record)) {
    auto created = RecordedSound::create(parts_, sound_->queue().sample_rate(), sound_->queue().channels());
    if (!created) return fail(created.error());
    sound.emplace(std::move(*created));
  }
  auto recording = Recording::open(arguments_.record, decoder().format(), std::move(sound));
  if (!recording) return fail(recording.error());
  recording_.emplace(std::move(*recording));
  return {};
}

Result<void> Player::run() {
  file_->on_wait([this] {
    interrupted_ = Window::has_events();
    return !interrupted_;
  });
  playback_.jump();  // the time spent opening the window does not count
  playback_.take(decoder().position().time, decoder().duration(), Playback::Clock::now());
  if (auto drawn = draw(); !drawn) return drawn;
  while (!quits_) {
    if (auto taken = take_events(); !taken) return taken;
    update_sound();
    if (!quits_ && drawn_ && (wanted_ || playback_.is_due(Playback::Clock::now())))
      if (auto gone = advance(); !gone) return gone;
    if (decoder().pictures() == 0) continue;  // still before the requested time
    if (!drawn_)
      if (auto drawn = draw(); !drawn) return drawn;
    if (!shown_)
      if (auto shown = show(); !shown) return shown;
  }
  return recording_ ? recording_->finish() : Result<void>{};
}

std::chrono::milliseconds Player::patience() const {
  if (wanted_) return std::chrono::milliseconds(0);
  if (!playback_.is_running()) return kIdle;
  const auto left =
      std::chrono::duration_cast<std::chrono::milliseconds>(playback_.until_due(Playback::Clock::now()));
  return std::min(left, kIdle);
}

Result<void> Player::advance() {
  const auto status = losses_.next(*file_);
  if (!status && std::exchange(interrupted_, false)) return {};
  const bool wanted = std::exchange(wanted_, false);
  if (status && *status == DecodeStatus::kPicture) {
    const auto now = Playback::Clock::now();
    const std::uint64_t begin = decoder().position().time;
    if (begin > next_) stop_sound();  // pictures are lost there
    next_ = begin + decoder().duration();
    playback_.take(begin, decoder().duration(), now);
    recorded_ = false;
    read_sound();
    // A recording leaves out no picture.
    if (wanted || recording_ || !playback_.is_late(now)) drawn_ = false;
    return {};
  }
  // A time past the end of a pipe of unknown length shows its last picture.
  const bool past_end = !status && status.error().code == ErrorCode::kInvalidArgument;
  if (!status && !past_end) return fail(status.error());
  if (decoder().pictures() == 0)
    return fail(ErrorCode::kInvalidStream, file_->name() + ": contains no pictures");
  if (past_end) drawn_ = false;
  end_stream();
  return {};
}

void Player::end_stream() {
  playback_.end();
  stop_sound();
  shown_ = false;
  length_ = decoder().position().time + decoder().duration();
  if (!std::exchange(reported_, true)) losses_.finish(*file_);
  // Loop only while playing: a viewer who steps wants to see the end.
  if (loops_ && !playback_.paused()) go_to(first_time());
}

void Player::go_to(std::uint64_t time) {
  if (length_ && *length_ > 0) time = std::min(time, *length_ - 1);
  file_->rejoin(time);
  prepare_decoder();
  playback_.jump();
  stop_sound();
  wanted_ = true;
}

void Player::step(int pictures) {
  stop_sound();
  playback_.pause(true, Playback::Clock::now());
  const std::uint64_t now = decoder().position().time;
  if (pictures > 0)
    wanted_ = !playback_.ended();
  else if (now > 0)
    go_to(now - 1);
}

Result<void> Player::take_events() {
  for (const WindowEvent& event : window_->events(patience())) {
    take(event);
    // Simultaneous keys take effect one after another, and a recording shows each.
    if (wanted_ && !quits_)
      if (auto gone = advance(); !gone) return gone;
    if (!drawn_ && recording_ && decoder().pictures() > 0)
      if (auto drawn = draw(); !drawn) return drawn;
  }
  return {};
}

void Player::take(const WindowEvent& event) {
  using Kind = WindowEvent::Kind;
  switch (event.kind) {
    case Kind::kClose:
      quits_ = true;
      break;
    case Kind::kRedraw:
      shown_ = false;
      break;
    case Kind::kTurn:
      stage_.edit.add(EditPart::kYaw, -turn(event.x));
      stage_.edit.add(EditPart::kPitch, turn(event.y));
      drawn_ = false;
      break;
    case Kind::kTilt:
      stage_.edit.add(EditPart::kRoll, turn(event.x));
      drawn_ = false;
      break;
    case Kind::kPlace:
      if (length_) go_to(static_cast<std::uint64_t>(event.x * static_cast<double>(*length_)));
      break;
    case Kind::kKey:
      if (const auto press = find_key(event.key)) take_key(*press);
      break;
  }
}

void Player::take_key(const KeyPress& press) {
  switch (press.action) {
    case Action::kPause:
    case Action::kStep:
    case Action::kSeek:
    case Action::kRestart:
    case Action::kLoop:
      return take_playing_key(press);
    case Action::kVolume:
    case Action::kMute:
      return take_sound_key(press);
    case Action::kFullScreen:
    case Action::kInfo:
    case Action::kSource:
    case Action::kHelp:
    case Action::kLeave:
    case Action::kQuit:
      return take_window_key(press);
    default:
      return take_picture_key(press);
  }
}

void Player::take_playing_key(const KeyPress& press) {
  const std::uint64_t now = decoder().position().time;
  shown_ = false;
  switch (press.action) {
    case Action::kPause:
      if (playback_.ended()) {
        playback_.pause(false, Playback::Clock::now());
        go_to(first_time());
      } else {
        stop_sound();
        playback_.pause(!playback_.paused(), Playback::Clock::now());
      }
      break;
    case Action::kStep:
      step(press.amount);
      break;
    case Action::kSeek: {
      const std::uint64_t far = ticks(std::abs(press.amount));
      go_to(press.amount > 0 ? now + far : now - std::min(now, far));
      break;
    }
    case Action::kRestart:
      go_to(first_time());
      break;
    default:
      loops_ = !loops_;
      if (loops_ && playback_.ended()) go_to(first_time());
      break;
  }
}

void Player::take_window_key(const KeyPress& press) {
  shown_ = false;
  switch (press.action) {
    case Action::kFullScreen:
      window_->set_full_screen(!window_->full_screen());
      break;
    case Action::kInfo:
      shows_info_ = !shows_info_;
      break;
    case Action::kSource:
      shows_source_ = !shows_source_ && source_;
      break;
    case Action::kHelp:
      shows_help_ = !shows_help_;
      break;
    case Action::kLeave:
      quits_ = !window_->full_screen();
      window_->set_full_screen(false);
      break;
    default:
      quits_ = true;
      break;
  }
}

void Player::take_picture_key(const KeyPress& press) {
  drawn_ = false;
  switch (press.action) {
    case Action::kWire:
      stage_.overlays.wire = !stage_.overlays.wire;
      break;
    case Action::kSnakes:
      stage_.overlays.snakes = !stage_.overlays.snakes;
      break;
    case Action::kPatterns:
      stage_.overlays.patterns = !stage_.overlays.patterns;
      break;
    case Action::kReset:
      stage_.edit.reset();
      break;
    case Action::kPattern:
      stage_.pattern = static_cast<std::size_t>(press.amount - 1);
      break;
    case Action::kNextPattern:
      stage_.choose_next(decoder(), press.amount);
      break;
    case Action::kOwnBlend:
      stage_.pattern.reset();
      break;
    default:
      if (const auto part = edited_part(press.action)) stage_.edit.step(*part, press.amount);
      break;
  }
}

}  // namespace fbs::cli
